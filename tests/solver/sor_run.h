/// Worlds in the sor stepper, for tests that look at how they move.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "stepping/stepper.h"

namespace pbmpi::solver {

/// A sor stepper with ODE's dCollide.
std::unique_ptr<stepping::WorldStepper> make_stepper(const stepping::StepperSettings& settings);

/// These worlds, ids 0, 1, ..., in a stepper of their own.
std::unique_ptr<stepping::WorldStepper> make_stepper(const stepping::StepperSettings& settings,
                                                     const std::vector<model::Model>& worlds);

void advance(stepping::WorldStepper& stepper, int num_steps);

/// The instruction sets of this machine, one lane included.
std::vector<stepping::Simd> machine_simds();

}  // namespace pbmpi::solver
