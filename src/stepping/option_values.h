/// Values of options as text: read with one clear message, and written so that they are read back bit for
/// bit.
#pragma once

#include <array>
#include <charconv>
#include <string>
#include <string_view>
#include <type_traits>

#include "core/error.h"
#include "model/names.h"

namespace pbmpi::stepping {

/// The enumerator that `text` names; `names` are in the order of the enumerators. `what` opens the message of
/// core::InputError, e.g. "--precision".
template <class Enum, std::size_t N>
Enum read_word(std::string_view text, const std::string& what, const std::array<std::string_view, N>& names) {
  if (const auto value = model::enum_from_name<Enum>(text, names)) return *value;
  std::string known;
  for (const std::string_view name : names) known.append(known.empty() ? "" : ", ").append(name);
  throw core::InputError(what + " " + std::string(text) + ": it must be one of " + known);
}

/// Throws core::InputError, opening with `what`, for anything but a number of this type.
template <class Number>
requires std::is_arithmetic_v<Number> Number read_number(std::string_view text, const std::string& what) {
  Number value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool is_number = error == std::errc{} && end == text.data() + text.size();
  core::require_input(is_number, what + " " + std::string(text) + ": it must be a " +
                                     (std::is_integral_v<Number> ? "whole " : "") + "number");
  return value;
}

/// With as few digits as it takes to read the number back.
template <class Number>
requires std::is_arithmetic_v<Number> std::string written(Number value) {
  std::array<char, 32> digits{};
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr;
  return std::string(digits.data(), end);
}

}  // namespace pbmpi::stepping
