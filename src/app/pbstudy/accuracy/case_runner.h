/// Runs one case of "pbstudy accuracy" on this rank.
#pragma once

#include <array>
#include <cmath>
#include <functional>
#include <type_traits>
#include <vector>

#include "analysis/error_bands.h"
#include "app/pbstudy/accuracy/accuracy_cases.h"
#include "app/pbstudy/accuracy/nature.h"
#include "app/pbstudy/study/case_stepper.h"
#include "app/pbstudy/study/study_scene.h"
#include "io/table/table_file.h"
#include "model/model.h"
#include "stepping/stepper.h"

namespace pbmpi::app {

/// World 0 of a scene, at rest, for so many seconds. NaN where nothing was measured.
struct RestResult {
  double fallen = 0;         ///< bodies that sank by more than fall_m, but not in the reference
  double fell_at_s = 0;      ///< when the first of them did; infinite if none
  double creep_m_s = 0;      ///< mean speed of the body that moved farthest in the second half
  double energy_gain_j = 0;  ///< gained without a cause
};

/// A third of the height of the lowest blocks of the nine scenes; a human whose head sinks this far is
/// falling.
inline constexpr double fall_m = 0.05;

/// How a setting treats a scene in which nothing happens: errors of one frame cannot show what accumulates.
class RestRunner {
 public:
  /// Runs the reference at once. `seconds`: 0 = nothing is measured.
  RestRunner(const StudyScene& scene, const stepping::StepperSettings& reference, double seconds);

  RestResult run(const stepping::StepperSettings& settings) const;

 private:
  struct Run {
    std::vector<double> sank_at_s;  ///< [num_bodies] infinite: never
    double creep_m_s = 0, energy_gain_j = 0;
  };
  Run run_scene(const stepping::StepperSettings& settings) const;

  StudyScene scene_;
  double seconds_;
  std::vector<double> reference_sank_at_s_;
};

/// Measurements of a case. Sent between ranks as its bytes.
struct CaseResult {
  int index = 0;  ///< index of the case
  // Processor time: other processes on the core disturb it far less than elapsed time.
  double frame_time_median_s = 0;  ///< over the measured frames of each frame's median over the repeats
  double frame_time_worst_s = 0;   ///< the largest of those medians: what a frame budget must hold
  double frame_time_p10_s = 0, frame_time_p90_s = 0;  ///< over all timings: the spread
  double rows = 0;                                    ///< of the last step, mean over the measured frames
  double row_visits = 0;                              ///< rows x sweeps of a frame, until the result is shown
  double max_joint_gap_m = 0, max_penetration_m = 0;  ///< after one frame from nature's states
  double energy_change_j = 0;     ///< largest distance from nature's energy after one frame
  RestResult rest;                ///< for a setting
  double solve_iterations = NAN;  ///< a step, for is_own(); otherwise NaN
  /// Of the bodies of all measured frames, for each of asked_m.
  std::array<double, asked_m.size()> determined{}, within{};
  analysis::ErrorTable defect;  ///< of what nature determines (keep_judged()); for nature its uncertainty
  /// Against the own solution (for is_own(): see OwnSolutions::judge()); no entries without one.
  analysis::ErrorTable own_defect;
  analysis::ErrorTable drift;
};
static_assert(std::is_trivially_copyable_v<CaseResult>);

/// States at the ends of the measured frames, each frame begun in nature's state: [frames][num_worlds].
using FrameEnds = std::vector<States>;

/// The errors of the measured frames from nature: those of the judged bodies, and how many are within what is
/// asked.
class DefectOf {
 public:
  explicit DefectOf(const Nature& nature) : nature_(nature) {}

  /// Takes the ends [num_worlds] of measured frame `i`.
  void add(const Worlds& worlds, const std::function<const model::State&(int world)>& end, std::size_t i);
  /// Takes the errors of a world in measured frame `i`.
  void add_errors(std::size_t world, std::size_t i, analysis::PoseErrors errors);
  void put_into(CaseResult& result) const;

 private:
  const Nature& nature_;
  analysis::PoseErrors errors_;
  WithinCounts counts_;
};

/// Runs a setting or an estimate. `own`: the ends of its own solution; null: no comparison with one.
CaseResult run_case(const AccuracyCase& one, const StudyScene& scene, const Nature& nature,
                    const RestRunner& rest, int repeats, const FrameEnds* own = nullptr);

/// The uncertainty of nature as a case's defect, and the time that it took.
CaseResult account_of(const Nature& nature);

/// A result whose observations are NaN; only what is measured later will be known.
CaseResult unobserved();

/// Sets the times of `result` from those of its measured frames [s], [frame][repeat].
void summarize_times(const std::vector<std::vector<double>>& times_s, CaseResult& result);

}  // namespace pbmpi::app
