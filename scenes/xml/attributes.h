/// Reads the attributes of one XML element, with types, ranges and the place of each error.
#pragma once

#include <cstddef>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/vector.h"
#include "scenes/xml/element.h"
#include "scenes/xml/leave_out.h"

namespace pbmpi::scenes::xml {

/// The allowed range of a number, which must always be finite.
enum class Range { any, positive, non_negative };

/// Each getter marks its attribute as known; finish() then refuses all others. All errors are
/// core::InputError "file:line:column: element 'name': ...". The needed parts of the element are copied, not
/// borrowed. Attributes of XML itself, whose names have a prefix (xmlns:a, xsi:b), never matter.
class Attributes {
 public:
  /// `defaults`: attributes that apply where the element has none of that name; the first of a name counts.
  explicit Attributes(const Element& element, const std::vector<Attribute>& defaults = {});
  /// Without the attributes that `leave_out` names.
  Attributes(const Element& element, const LeaveOut& leave_out, const std::vector<Attribute>& defaults = {})
      : Attributes(element, defaults) {
    drop(leave_out);
  }

  /// Takes the attributes that `leave_out` names as missing, with notes.
  void drop(const LeaveOut& leave_out);
  bool has(std::string_view name);
  std::string text(std::string_view name, const std::optional<std::string>& fallback = std::nullopt);
  double number(std::string_view name, Range range = Range::any,
                std::optional<double> fallback = std::nullopt);
  int integer(std::string_view name, int least, int fallback);
  /// Reads from `least` to `most` numbers; empty without the attribute.
  std::vector<double> numbers(std::string_view name, std::size_t least, std::size_t most);
  core::Vec3 vector(std::string_view name, const std::optional<core::Vec3>& fallback = std::nullopt);
  /// Reads a vector and scales it to unit length; refuses zero.
  core::Vec3 direction(std::string_view name, const core::Vec3& fallback);
  /// Reads a quaternion (w, x, y, z), or (x, y, z, w) with `real_last`, and scales it to unit length; refuses
  /// zero. The attribute must be there.
  core::Quat turn(std::string_view name, bool real_last = false);
  /// Reads "true" or "false".
  bool flag(std::string_view name, bool fallback);
  /// Reads one of `words`.
  std::string word(std::string_view name, std::initializer_list<std::string_view> words,
                   std::string_view fallback);

  /// Allows attributes whose values do not matter here.
  void allow(std::initializer_list<std::string_view> names);
  /// Refuses any of these attributes, with this reason and the advice to leave it out.
  void refuse(std::initializer_list<std::string_view> names, const std::string& problem);
  /// To be called when all attributes have been read.
  void finish() const;
  /// finish() where other tools may add attributes of their own, which get a note: only what may be meant for
  /// an attribute that is missing here is refused.
  void finish(Notes& notes) const;

  const std::string& where() const { return where_; }
  /// The place of the attribute, or of the element if it has no attribute of that name.
  std::string where(std::string_view name) const;
  [[noreturn]] void fail(const std::string& problem) const;
  [[noreturn]] void fail(std::string_view name, const std::string& problem) const;
  /// fail() for what can also be left out: "problem, or leave it out (...)". `left_out`: what to name for
  /// that; empty: the attribute.
  [[noreturn]] void fail_unless_left_out(std::string_view name, const std::string& problem,
                                         std::string_view left_out = {}) const;

 private:
  const Attribute* find(std::string_view name);
  const Attribute* peek(std::string_view name) const;
  std::vector<const Attribute*> unknown() const;
  [[noreturn]] void fail_unknown(const Attribute& attribute, const std::vector<std::string>& names) const;
  double to_number(const Attribute& attribute, std::string_view word) const;

  std::string what_, where_;
  std::vector<Attribute> attributes_;
  std::vector<std::string> known_;
};

/// Refuses an element, with the advice to leave it out: "problem, or leave it out (...)".
[[noreturn]] void refuse_element(const Element& element, const std::string& problem);

}  // namespace pbmpi::scenes::xml
