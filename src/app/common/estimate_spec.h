/// How the frames of a run are estimated before they are computed (FEEC).
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string_view>

#include "stepping/estimator.h"
#include "stepping/stepper.h"

namespace pbmpi::app {

/// Where an estimate comes from.
enum class EstimateSource {
  short_run,   ///< a run of its own: the whole frame, or what follows its first precise steps
  same_solve,  ///< a look at the precise solve of the frame's last step
  until_due,   ///< what can be had by the time the estimate is due
};
inline constexpr std::array<std::string_view, 3> estimate_source_names = {"short_run", "same_solve",
                                                                          "until_due"};

struct EstimateSpec {
  stepping::StepperSettings stepper;  ///< of the part that is not precise
  EstimateSource source = EstimateSource::short_run;
  int after = 0;                ///< number of precise steps at the start of a frame
  std::optional<double> due_s;  ///< from the start of a frame until its estimate is due
};

/// The settings of an estimate of `precise` unless it is given others: one sweep in each of a sixth of
/// its substeps.
stepping::StepperSettings default_estimate(const stepping::StepperSettings& precise);

/// `same_solve` where the precise solve is the only one left of the frame, and passes the wanted iteration.
EstimateSource source_of(const EstimateSpec& estimate, const stepping::StepperSettings& precise,
                         int steps_per_frame);

/// `precise`, borrowed, computes the precise frames.
std::unique_ptr<stepping::Estimator> make_estimator(const EstimateSpec& estimate,
                                                    stepping::FrameStepper& precise);

}  // namespace pbmpi::app
