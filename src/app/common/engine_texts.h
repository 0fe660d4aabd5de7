/// What a run's file and summary say of the engine that steps it.
#pragma once

#include <string>

#include "stepping/stepper.h"

namespace pbmpi::app {

/// The vector instructions that the stepper uses and its lanes, e.g. "avx512, 16 lanes"; empty for ODE's.
std::string simd_text(const stepping::StepperSettings& settings);

/// ODE's version, with its precision if that is single.
std::string ode_text();

}  // namespace pbmpi::app
