/// Numbers with a unit: "3.33ms", "1cm".
#pragma once

#include <optional>
#include <span>
#include <string_view>

namespace pbmpi::core {

struct Unit {
  std::string_view name;
  double factor = 1;  ///< the unit in SI units
};

/// us, ms, s
std::span<const Unit> times();
/// mm, cm, m
std::span<const Unit> lengths();

/// The number in one of these units, in SI; empty for anything else, including a number that is not finite
/// and above 0.
std::optional<double> quantity(std::string_view text, std::span<const Unit> units);

}  // namespace pbmpi::core
