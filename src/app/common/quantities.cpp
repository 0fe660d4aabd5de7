#include "app/common/quantities.h"

#include <span>

#include "core/error.h"
#include "core/quantity.h"

namespace pbmpi::app {
namespace {

double require_quantity(const std::string& text, const std::string& option, std::span<const core::Unit> units,
                        const char* example) {
  if (const auto value = core::quantity(text, units)) return *value;
  std::string known;
  for (const core::Unit& unit : units) known.append(known.empty() ? "" : ", ").append(unit.name);
  throw core::InputError(option + " " + text + ": it must be a number above 0 and a unit (" + known +
                         "), e.g. " + example);
}

}  // namespace

double parse_time_s(const std::string& text, const std::string& option) {
  return require_quantity(text, option, core::times(), "3.33ms");
}

double parse_time_or_seconds(const std::string& text, const std::string& option) {
  constexpr core::Unit seconds_alone{"", 1};
  if (const auto seconds = core::quantity(text, {&seconds_alone, 1})) return *seconds;
  return parse_time_s(text, option);
}

double parse_length_m(const std::string& text, const std::string& option) {
  return require_quantity(text, option, core::lengths(), "1cm");
}

}  // namespace pbmpi::app
