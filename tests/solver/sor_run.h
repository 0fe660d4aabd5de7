/// Worlds in the sor stepper, for tests that look at how they move.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "model/stepper.h"

namespace pbmpi::solver {

/// A sor stepper with ODE's dCollide.
std::unique_ptr<model::WorldStepper> make_stepper(const model::StepperSettings& settings);

/// These worlds, ids 0, 1, ..., in a stepper of their own.
std::unique_ptr<model::WorldStepper> make_stepper(const model::StepperSettings& settings,
                                                  const std::vector<model::Model>& worlds);

void advance(model::WorldStepper& stepper, int num_steps);

/// The instruction sets of this machine, one lane included.
std::vector<model::Simd> machine_simds();

}  // namespace pbmpi::solver
