/// An XML file as plain data in which each element and attribute knows its place.
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
  std::vector<Element> children;  ///< only elements; text and comments are left out

  /// The attribute; null if there is none.
  const Attribute* find(std::string_view attribute) const;
};

/// The deepest allowed nesting of elements: more would overflow the stack of recursive functions.
inline constexpr int most_nesting = 500;

/// Is the text XML rather than TOML, which never begins with '<'? White space and a byte order mark are
/// skipped.
bool is_xml(std::string_view text);

/// Parses `text` and returns its root element; `file` is its name in messages. Throws core::InputError
/// "file:line:column: ..." where the text is not well formed, has no root or more than one, gives an
/// attribute twice, or is nested too deeply.
Element parse(std::string_view text, const std::string& file);

}  // namespace pbmpi::scenes::xml
