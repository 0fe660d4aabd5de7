/// How the frames of a run are estimated before they are computed (FEEC).
#pragma once

#include <array>
#include <memory>
#include <string>
#include <string_view>

#include "stepping/estimator.h"
#include "stepping/stepper.h"

namespace pbmpi::app {

/// The settings of an estimate of `precise` unless it is given others: one sweep in each of a sixth of
/// its substeps.
stepping::StepperSettings default_estimate(const stepping::StepperSettings& precise);

/// The settings of an estimate of `precise` that `setting` names: nothing, or words such as "quick",
/// "iterations=5", "sor iterations=3 precision=single"; what it leaves open is as in default_estimate().
/// Throws core::InputError for any other.
stepping::StepperSettings estimate_settings(const std::string& setting,
                                            const stepping::StepperSettings& precise);

/// The step options that an estimate may have otherwise than the precise stepper.
inline constexpr std::array<std::string_view, 3> estimate_options = {"stepper", "iterations", "precision"};

/// As a setting that estimate_settings() reads: "sor iterations=1 precision=double".
std::string estimate_text(const stepping::StepperSettings& estimate);

/// An estimator that makes a short run of each frame.
std::unique_ptr<stepping::Estimator> make_estimator(const stepping::StepperSettings& settings);

}  // namespace pbmpi::app
