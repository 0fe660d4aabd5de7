/// Worlds in the sor stepper, for tests of their motion.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "stepping/stepper.h"

namespace pbmpi::solver {

/// A sor stepper with ODE's dCollide.
std::unique_ptr<stepping::WorldStepper> make_stepper(const stepping::StepperSettings& settings);

/// A stepper with these worlds, ids 0, 1, ...
std::unique_ptr<stepping::WorldStepper> make_stepper(const stepping::StepperSettings& settings,
                                                     const std::vector<model::Model>& worlds);

void advance(stepping::WorldStepper& stepper, int num_steps);

/// The instruction sets of this machine, including one lane.
std::vector<stepping::Simd> machine_simds();

}  // namespace pbmpi::solver
