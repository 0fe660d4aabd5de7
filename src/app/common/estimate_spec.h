/// How the frames of a run are estimated before they are computed (FEEC).
#pragma once

#include <memory>

#include "stepping/estimator.h"
#include "stepping/stepper.h"

namespace pbmpi::app {

/// The settings of an estimate of `precise` unless it is given others: one sweep in each of a sixth of
/// its substeps.
stepping::StepperSettings default_estimate(const stepping::StepperSettings& precise);

/// An estimator that makes a short run of each frame.
std::unique_ptr<stepping::Estimator> make_estimator(const stepping::StepperSettings& settings);

}  // namespace pbmpi::app
