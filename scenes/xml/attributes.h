/// The attributes of one XML element, read with types, ranges and the place of every mistake.
#pragma once

#include <cstddef>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/vector.h"
#include "scenes/xml/element.h"

namespace pbmpi::scenes::xml {

/// What a number may be, besides finite.
enum class Range { any, positive, non_negative };

/// Each getter marks its attribute as known; finish() then refuses those that nobody asked for. All errors
/// are core::InputError "file:line:column: element 'name': ...". The element is copied in parts, not
/// borrowed.
class Attributes {
 public:
  /// `defaults`: attributes that hold where the element has none of that name; the first of a name counts.
  explicit Attributes(const Element& element, const std::vector<Attribute>& defaults = {});

  bool has(std::string_view name);
  std::string text(std::string_view name, const std::optional<std::string>& fallback = std::nullopt);
  double number(std::string_view name, Range range = Range::any,
                std::optional<double> fallback = std::nullopt);
  int integer(std::string_view name, int least, int fallback);
  /// From `least` to `most` numbers; empty without the attribute.
  std::vector<double> numbers(std::string_view name, std::size_t least, std::size_t most);
  core::Vec3 vector(std::string_view name, const std::optional<core::Vec3>& fallback = std::nullopt);
  /// Scaled to unit length; refuses zero.
  core::Vec3 direction(std::string_view name, const core::Vec3& fallback);
  /// "true" or "false".
  bool flag(std::string_view name, bool fallback);
  /// One of `words`.
  std::string word(std::string_view name, std::initializer_list<std::string_view> words,
                   std::string_view fallback);

  /// Attributes that may be there and say nothing that matters here.
  void allow(std::initializer_list<std::string_view> names);
  /// Refuses any of these, with this reason and advice.
  void refuse(std::initializer_list<std::string_view> names, const std::string& problem);
  /// Call when all attributes have been asked for.
  void finish() const;

  const std::string& where() const { return where_; }
  /// Of the attribute, or of the element if it has none of that name.
  std::string where(std::string_view name) const;
  [[noreturn]] void fail(const std::string& problem) const;
  [[noreturn]] void fail(std::string_view name, const std::string& problem) const;

 private:
  const Attribute* find(std::string_view name);
  const Attribute* peek(std::string_view name) const;
  double to_number(const Attribute& attribute, std::string_view word) const;

  std::string what_, where_;
  std::vector<Attribute> attributes_;
  std::vector<std::string> known_;
};

}  // namespace pbmpi::scenes::xml
