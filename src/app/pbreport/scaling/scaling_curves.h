/// Runs of the same work on different numbers of ranks, as curves of speed-up and efficiency.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/pbreport/scaling/scaling_run.h"
#include "core/statistics.h"

namespace pbmpi::app {

/// What a point must have to be reported.
struct ScalingRules {
  int least_repeats = 5;
  double widest_interval = 0.1;  ///< of the speed-up, over its median
};

/// The median of a sample, and where that of its distribution lies.
struct Estimated {
  double median = 0;
  core::Interval interval;
};

/// Runs of one work on as many ranks, decomposed alike.
struct ScalingPoint {
  int ranks = 0, worlds = 0;
  std::string decomposition;
  std::vector<const ScalingRun*> runs;  ///< in the order of their starts

  /// Of the k-th run against the k-th run of the curve's base, since what both share of the machine's noise
  /// falls out of the ratio: worlds simulated in a second.
  Estimated speed_up;
  Estimated efficiency;             ///< speed-up over that of as many times more ranks
  double computation = 1;           ///< useful time of the base, for as many worlds, over that of this point
  std::vector<std::string> doubts;  ///< why it should not be reported; empty: it can be

  double median_of(double ScalingRun::*value) const;
  double median_of(double PopEfficiencies::*value) const;
};

enum class ScalingKind {
  strong,  ///< as many worlds on more ranks
  weak,    ///< as many more worlds as ranks
};

struct ScalingCurve {
  ScalingKind kind = ScalingKind::strong;
  std::string decomposition;          ///< of all points but, in a strong curve, some on the fewest ranks
  std::size_t base = 0;               ///< index of the point that the others are compared with
  std::vector<ScalingPoint> points;   ///< by ranks
  const ScalingRun* first = nullptr;  ///< of the base: scene, stepper ...
  /// Of a strong curve: from a run of the same worlds on one rank that recorded islands, whatever its
  /// stepper.
  std::optional<Figure6Bars> figure6;
};

/// Strong curves, then weak ones, in the order in which the first runs of their scenes were given. The base
/// is the fastest point on the fewest ranks, whatever its decomposition. `runs` is borrowed.
std::vector<ScalingCurve> curves_of(const std::vector<ScalingRun>& runs, const ScalingRules& rules);

/// Files of `runs` that are in no curve.
std::vector<std::string> files_without_curve(const std::vector<ScalingRun>& runs,
                                             const std::vector<ScalingCurve>& curves);

}  // namespace pbmpi::app
