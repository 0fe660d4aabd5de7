/// One world cut into spaces, as one rank steps it with pbmpi's own projected SOR.
#pragma once

#include <memory>

#include "model/contact.h"
#include "stepping/space_stepper.h"
#include "stepping/stepper.h"

namespace pbmpi::solver {

/// Holds a pack of all the world's articulations, with its own side by side in front, and in a step moves
/// only those that it is told to. Throws core::InputError like make_sor_stepper().
std::unique_ptr<stepping::SpaceStepper> make_sor_space_stepper(
    const stepping::StepperSettings& settings, const model::MakeNarrowPhase& make_narrow_phase,
    std::shared_ptr<const model::Model> model);

}  // namespace pbmpi::solver
