#include "app/common/quantities.h"

#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "core/error.h"

namespace pbmpi::app {
namespace {

using Units = std::vector<std::pair<std::string_view, double>>;

const Units times = {{"us", 1e-6}, {"ms", 1e-3}, {"s", 1}};
const Units lengths = {{"mm", 1e-3}, {"cm", 1e-2}, {"m", 1}};

/// The number in one of the units, or nothing.
std::optional<double> quantity(std::string_view text, const Units& units) {
  double number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc{} || !(number > 0) || !std::isfinite(number)) return std::nullopt;
  const std::string_view given = text.substr(static_cast<std::size_t>(end - text.data()));
  for (const auto& [unit, factor] : units) {
    if (given == unit) return number * factor;
  }
  return std::nullopt;
}

double require_quantity(const std::string& text, const std::string& option, const Units& units,
                        const char* example) {
  if (const auto value = quantity(text, units)) return *value;
  std::string known;
  for (const auto& [unit, factor] : units) known.append(known.empty() ? "" : ", ").append(unit);
  throw core::InputError(option + " " + text + ": it must be a number above 0 and a unit (" + known +
                         "), e.g. " + example);
}

}  // namespace

double parse_time_s(const std::string& text, const std::string& option) {
  return require_quantity(text, option, times, "3.33ms");
}

double parse_time_or_seconds(const std::string& text, const std::string& option) {
  if (const auto seconds = quantity(text, {{"", 1}})) return *seconds;
  return parse_time_s(text, option);
}

double parse_length_m(const std::string& text, const std::string& option) {
  return require_quantity(text, option, lengths, "1cm");
}

}  // namespace pbmpi::app
