#include "core/quantity.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "core/error.h"
#include "core/text.h"

namespace pbmpi::core {
namespace {

std::string_view si_unit(const Measure& measure) {
  return std::ranges::find(measure.units, 1.0, &Unit::factor)->name;
}

bool is_plausible_bare(double value, const Measure& measure) {
  return value == 0 || (value >= measure.least_bare && value <= measure.most_bare);
}

[[noreturn]] void refuse(const std::string& given, const Measure& measure) {
  std::string known;
  for (const Unit& unit : measure.units) known.append(known.empty() ? "" : ", ").append(unit.name);
  throw InputError(given + ": it must be a finite number above 0" + (measure.may_be_zero ? ", or 0," : "") +
                   " with a unit (" + known + "), e.g. " + std::string(measure.example));
}

}  // namespace

std::string_view bound_against(double value, bool is_positive) {
  static_assert(largest_number == 1e30 && smallest_number == 1e-30);
  if (std::isfinite(value) && std::abs(value) > largest_number)
    return "from -1e30 to 1e30, for the solver to carry its products";
  if (is_positive && value < smallest_number) return "at least 1e-30, for the solver to carry its products";
  return "";
}

double read_quantity(std::string_view text, const std::string& what, const Measure& measure) {
  const std::string given = what + " " + std::string(text);
  double number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  const bool is_allowed = number > 0 || (number == 0 && measure.may_be_zero);
  if (error != std::errc{} || !is_allowed || !std::isfinite(number)) refuse(given, measure);
  const std::string_view name = text.substr(static_cast<std::size_t>(end - text.data()));
  if (!name.empty()) {
    const auto unit = std::ranges::find(measure.units, name, &Unit::name);
    if (unit == measure.units.end()) refuse(given, measure);
    return number * unit->factor;
  }
  const std::string with_unit = std::string(text) + std::string(si_unit(measure));
  require_input(is_plausible_bare(number, measure), given + ": is that " + with_unit +
                                                        "? Write its unit, e.g. " +
                                                        std::string(measure.example) + " or " + with_unit);
  return number;
}

std::string quantity_text(double value, const Measure& measure) {
  return number_text(value) + std::string(is_plausible_bare(value, measure) ? "" : si_unit(measure));
}

}  // namespace pbmpi::core
