/// What a run's file and summary say about the engine that steps it.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "stepping/stepper.h"

namespace pbmpi::app {

/// The stepper's vector instructions and lanes, e.g. "avx512, 16 lanes"; empty for a stepper without a choice
/// of instructions.
std::string simd_text(const stepping::StepperSettings& settings);

/// ODE's version, with its precision if that is single.
std::string ode_text();

/// Name and version of the engine behind bullet or mujoco, e.g. "library_bullet" and "3.24, double
/// precision"; nothing for the other steppers.
std::optional<std::pair<std::string, std::string>> optional_engine_text(stepping::StepperKind kind);

/// Names and versions of all engines of this build, as above.
std::vector<std::pair<std::string, std::string>> engine_versions();

}  // namespace pbmpi::app
