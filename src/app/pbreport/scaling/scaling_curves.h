/// Runs of the same work on different numbers of ranks, as curves of speed-up and efficiency.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/pbreport/scaling/scaling_run.h"
#include "core/statistics.h"

namespace pbmpi::app {

/// The requirements for a point to be reported.
struct ScalingRules {
  int least_repeats = 5;
  double widest_interval = 0.1;  ///< of the speed-up, relative to its median
};

/// The median of a sample, and a confidence interval for the distribution's median.
struct Estimated {
  double median = 0;
  core::Interval interval;
};

/// Runs of one work on the same number of ranks, with the same decomposition.
struct ScalingPoint {
  int ranks = 0, worlds = 0;
  std::string decomposition;
  std::vector<const ScalingRun*> runs;  ///< in the order of their starts

  /// Ratio of worlds simulated per second between the k-th run and the k-th run of the curve's base, so that
  /// noise of the machine common to both cancels.
  Estimated speed_up;
  Estimated efficiency;    ///< speed-up divided by the growth in ranks
  double computation = 1;  ///< useful time of the base, for as many worlds, divided by that of this point
  std::vector<std::string> doubts;  ///< why it should not be reported; empty: nothing against it

  double median_of(double ScalingRun::*value) const;
  double median_of(double PopEfficiencies::*value) const;
};

enum class ScalingKind {
  strong,  ///< the same number of worlds on more ranks
  weak,    ///< worlds grow with the ranks
};

struct ScalingCurve {
  ScalingKind kind = ScalingKind::strong;
  std::string decomposition;          ///< of all points except, in a strong curve, some on the fewest ranks
  std::size_t base = 0;               ///< index of the point that the others are compared with
  std::vector<ScalingPoint> points;   ///< by ascending ranks
  const ScalingRun* first = nullptr;  ///< of the base: gives scene, stepper ...
  /// For a strong curve: from a run of the same worlds on one rank that recorded islands, with any stepper.
  std::optional<Figure6Bars> figure6;
};

/// Strong curves, then weak ones, in the order in which the first runs of their scenes were given. The base
/// is the fastest point on the fewest ranks, whatever its decomposition. `runs` is borrowed.
std::vector<ScalingCurve> curves_of(const std::vector<ScalingRun>& runs, const ScalingRules& rules);

/// Files of `runs` that belong to no curve.
std::vector<std::string> files_without_curve(const std::vector<ScalingRun>& runs,
                                             const std::vector<ScalingCurve>& curves);

}  // namespace pbmpi::app
