#include "core/quantity.h"

#include <array>
#include <charconv>
#include <cmath>

namespace pbmpi::core {
namespace {

constexpr std::array<Unit, 3> time_units = {{{"us", 1e-6}, {"ms", 1e-3}, {"s", 1}}};
constexpr std::array<Unit, 3> length_units = {{{"mm", 1e-3}, {"cm", 1e-2}, {"m", 1}}};

}  // namespace

std::span<const Unit> times() { return time_units; }
std::span<const Unit> lengths() { return length_units; }

std::optional<double> quantity(std::string_view text, std::span<const Unit> units) {
  double number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc{} || !(number > 0) || !std::isfinite(number)) return std::nullopt;
  const std::string_view given = text.substr(static_cast<std::size_t>(end - text.data()));
  for (const Unit& unit : units) {
    if (given == unit.name) return number * unit.factor;
  }
  return std::nullopt;
}

}  // namespace pbmpi::core
