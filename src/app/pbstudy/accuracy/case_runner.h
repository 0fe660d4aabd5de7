/// Runs one case of "pbstudy accuracy" on this rank.
#pragma once

#include <cmath>
#include <functional>
#include <type_traits>
#include <vector>

#include "analysis/error_table.h"
#include "app/pbstudy/accuracy/accuracy_cases.h"
#include "app/pbstudy/accuracy/rest_runner.h"
#include "app/pbstudy/study/case_stepper.h"

namespace pbmpi::app {

/// Measurements of a case. Sent between ranks as its bytes.
struct CaseResult {
  int index = 0;  ///< index of the case
  // Processor time: other processes on the core disturb it far less than elapsed time.
  double frame_time_median_s = 0;  ///< over the measured frames of each frame's median over the repeats
  double frame_time_worst_s = 0;   ///< the largest of those medians: what a frame budget must hold
  double frame_time_p10_s = 0, frame_time_p90_s = 0;  ///< over all timings: the spread
  double rows = 0;                                    ///< of the last step, mean over the measured frames
  double row_visits = 0;                              ///< rows x sweeps of a frame, until the result is shown
  double max_joint_gap_m = 0, max_penetration_m = 0;  ///< after one frame from the reference's states
  double energy_change_j = 0;     ///< largest distance from the reference's energy after one frame
  double momentum_change_ns = 0;  ///< largest distance from the reference's linear momentum
  double max_stretch = 0;         ///< of a human segment after one frame
  RestResult rest;                ///< for a setting
  double solve_residual = NAN;    ///< for a case solved like the reference (SolveAccount); otherwise NaN
  double solve_iterations = NAN;
  analysis::ErrorTable defect;
  /// Against the own solution (for is_own(): see OwnSolutions::judge()); no entries without one.
  analysis::ErrorTable own_defect;
  analysis::ErrorTable drift;
};
static_assert(std::is_trivially_copyable_v<CaseResult>);

/// States at the ends of the measured frames, each frame begun in the reference's state:
/// [frames][num_worlds].
using FrameEnds = std::vector<std::vector<model::State>>;

/// The states [num_worlds] of all worlds.
using States = std::vector<model::State>;
/// Computes frame `frame` from these states.
using SolveFrame = std::function<States(const States& start, int frame)>;

/// The errors of the measured frames of a run from the reference's first states.
analysis::ErrorTable drift_of(const StudyScene& scene, const Reference& reference, const Worlds& worlds,
                              const SolveFrame& solve);

/// Runs a setting or an estimate. `own`: the ends of its own solution; null: no comparison with one.
CaseResult run_case(const AccuracyCase& one, const StudyScene& scene, const Reference& reference,
                    const RestRunner& rest, int repeats, const FrameEnds* own = nullptr);

/// A result whose observations are NaN; only what is measured later will be known.
CaseResult unobserved();

/// Sets the times of `result` from those of its measured frames [s], [frame][repeat].
void summarize_times(const std::vector<std::vector<double>>& times_s, CaseResult& result);

}  // namespace pbmpi::app
