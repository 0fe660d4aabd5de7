/// Makes the stepper that a run asks for.
#pragma once

#include <memory>
#include <string>

#include "stepping/space_stepper.h"
#include "stepping/stepper.h"

namespace pbmpi::engines {

/// quick and direct are ODE's; sor is pbmpi's own, with ODE's dCollide; bullet and mujoco belong to the
/// engines of optional_engines.h. Throws core::InputError for settings that the stepper refuses, and for a
/// stepper that this build lacks. Warnings go to stderr after `warning_prefix`.
std::unique_ptr<stepping::WorldStepper> make_stepper(const stepping::StepperSettings& settings,
                                                     const std::string& warning_prefix = "");

/// A stepper of one world that is cut into spaces: sor.
std::unique_ptr<stepping::SpaceStepper> make_space_stepper(const stepping::StepperSettings& settings,
                                                           std::shared_ptr<const model::Model> model);

}  // namespace pbmpi::engines
