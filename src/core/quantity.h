/// Numbers with a unit: "3.33ms", "1cm"; and the numbers that a solver can carry.
#pragma once

#include <array>
#include <limits>
#include <span>
#include <string>
#include <string_view>

namespace pbmpi::core {

/// Bounds of what a scene says of masses, lengths, speeds and the like, in SI units: products of several such
/// numbers, e.g. the cube of an inertia or an energy times a mass, stay finite in double precision.
inline constexpr double largest_number = 1e30, smallest_number = 1e-30;

/// What a number must be that is outside of these bounds, e.g. "from -1e30 to 1e30, for the solver to carry
/// its products", as messages say after "it must be"; empty for a number within them, and for infinity.
/// `is_positive`: whether it is above 0 by its meaning, so that smallest_number bounds it, too.
std::string_view bound_against(double value, bool is_positive);

struct Unit {
  std::string_view name;
  double factor = 1;  ///< the unit in SI units
};

inline constexpr std::array<Unit, 5> time_units = {
    {{"us", 1e-6}, {"ms", 1e-3}, {"s", 1}, {"min", 60}, {"h", 3600}}};
inline constexpr std::array<Unit, 3> length_units = {{{"mm", 1e-3}, {"cm", 1e-2}, {"m", 1}}};

/// A kind of quantity. A number without a unit is taken in SI units, but one outside of [least_bare,
/// most_bare] is probably meant in another unit, and asked about.
struct Measure {
  std::span<const Unit> units;
  double least_bare = 0, most_bare = 0;
  std::string_view example;  ///< for messages
  bool may_be_zero = false;
};

inline constexpr Measure step_time = {time_units, 1e-6, 0.5, "10ms"};
inline constexpr Measure frame_time = {time_units, 1e-6, 1, "3.33ms"};
inline constexpr Measure run_time = {time_units, 0, 1e7, "90s"};
inline constexpr Measure run_time_or_none = {time_units, 0, 1e7, "3s", true};
inline constexpr Measure tolerance = {length_units, 1e-9, 1e-3, "0.1mm", true};
/// Never without a unit.
inline constexpr Measure length_with_unit = {length_units, std::numeric_limits<double>::infinity(), 0, "1cm",
                                             true};

/// The number that `text` names, in SI units: finite, above 0 or, where it may be, 0. Throws InputError,
/// opening with `what` (e.g. "--budget"), for anything else, and for a number without a unit that is to be
/// asked about.
double read_quantity(std::string_view text, const std::string& what, const Measure& measure);

/// The text of a number in SI units that read_quantity() reads back bit for bit: without a unit, unless a
/// bare number would be asked about.
std::string quantity_text(double value, const Measure& measure);

}  // namespace pbmpi::core
