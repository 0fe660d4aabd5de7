/// A case that is known to be hard: what is measured in it, and which numbers still count as right.
#pragma once

#include <array>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/vector.h"

namespace pbmpi::stability {

/// A number that is measured in every run of a case, the worst over all its steps unless it says otherwise.
enum class Metric {
  nonfinite,
  energy_gain,
  energy_change,
  linear_momentum,
  angular_momentum,
  joint_gap,
  joint_gap_rms,
  penetration,
  escaped,
  drift,
  sink,
  creep,
  speed
};

struct MetricTraits {
  std::string_view name;  ///< its name in scene files and in the study's file
  std::string_view unit;
  std::string_view meaning;
};

/// Indexed by Metric.
inline constexpr std::array<MetricTraits, 13> metric_table = {{
    {"nonfinite", "", "bodies with a NaN or an infinity"},
    {"energy_gain", "J", "energy gained since its lowest, beyond what motors, launches and springs gave"},
    {"energy_change", "", "distance of the energy from that of the start, as a share of it"},
    {"linear_momentum", "", "change of the linear momentum, as a share of the largest part of the start's"},
    {"angular_momentum", "", "change of the angular momentum, as a share of the start's"},
    {"joint_gap", "m", "largest gap of a joint that holds"},
    {"joint_gap_rms", "m", "root of the mean square of all gaps of all steps"},
    {"penetration", "m", "deepest contact, the first step left out"},
    {"escaped", "", "bodies outside of the case's region at once"},
    {"drift", "m", "longest way of a watched body from its start"},
    {"sink", "m", "farthest descent of a watched body below its start"},
    {"creep", "m/s", "mean speed of the watched body that went farthest in the second half of the run"},
    {"speed", "m/s", "largest speed of a watched body once the case has settled"},
}};
inline constexpr std::size_t num_metrics = metric_table.size();

/// A run is right up to `right`, broken beyond `broken`, and degraded in between.
struct Limits {
  double right = 0;
  double broken = 0;
};

struct Bound {
  Metric metric = Metric::nonfinite;
  Limits limits;
};

/// A number of one body that the oracle knows.
enum class Quantity { x, y, z, vx, vy, vz, speed, way, turn };
inline constexpr std::array<std::string_view, 9> quantity_names = {"x",  "y",     "z",   "vx",  "vy",
                                                                   "vz", "speed", "way", "turn"};

/// A body's number [m], [m/s]; `way` is the distance from the start [m]; `turn` is the rotation from the
/// start [rad], the shortest one.
struct Expectation {
  std::string body;
  Quantity quantity = Quantity::x;
  double at_s = 0;
  double value = 0;  ///< the oracle's value
  Limits off_by;     ///< distance from it
};

/// The region in which all bodies have to stay, world frame [m].
struct Region {
  core::Vec3 low = core::Vec3::Constant(-std::numeric_limits<double>::infinity());
  core::Vec3 high = core::Vec3::Constant(std::numeric_limits<double>::infinity());
};

/// A scene file's [case].
struct HardCase {
  std::string group;   ///< e.g. "rest"
  int row = 0;         ///< row of the list of hard cases in docs/stability.md
  std::string source;  ///< source of the case or its bound
  std::string oracle;  ///< what should happen, one line
  double seconds = 10;
  double settle_s = 2;  ///< time from which on `speed` counts
  /// Name prefixes of watched bodies; none: all bodies.
  std::vector<std::string> watch;
  Region region;
  std::vector<Bound> bounds;
  std::vector<Expectation> expectations;
};

}  // namespace pbmpi::stability
