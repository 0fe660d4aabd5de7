/// How a setting treats a scene in which nothing happens: errors of one frame cannot show what accumulates.
#pragma once

#include <vector>

#include "app/pbstudy/study/study_scene.h"
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

}  // namespace pbmpi::app
