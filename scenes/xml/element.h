/// An XML file as plain data in which everything knows its place.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace pbmpi::scenes::xml {

struct Attribute {
  std::string name;
  std::string value;
  std::string where;  ///< "file:line:column"
};

struct Element {
  std::string name;
  std::string where;  ///< "file:line:column"
  std::vector<Attribute> attributes;
  std::vector<Element> children;  ///< elements alone; text and comments are left out

  /// Null if there is none.
  const Attribute* find(std::string_view attribute) const;
};

/// How deep elements may lie in each other: more would end the stack of those who walk through them.
inline constexpr int most_nesting = 500;

/// Is the text XML rather than TOML, which never begins with '<'? White space and a byte order mark apart.
bool is_xml(std::string_view text);

/// The root element of `text`; `file` is what messages call it. Throws core::InputError "file:line:column:
/// ..." where it is not well formed, has no root or more than one, gives an attribute twice, or is nested too
/// deeply.
Element parse(std::string_view text, const std::string& file);

}  // namespace pbmpi::scenes::xml
