/// One world cut into spaces, as one rank steps it with pbmpi's own projected SOR.
#pragma once

#include <memory>

#include "model/contact.h"
#include "stepping/space_stepper.h"
#include "stepping/stepper.h"

namespace pbmpi::solver {

/// Holds a pack of all the world's articulations, own ones side by side in front, and moves in a step only
/// those that it is told to. Throws core::InputError as make_sor_stepper() does.
std::unique_ptr<stepping::SpaceStepper> make_sor_space_stepper(
    const stepping::StepperSettings& settings, const model::MakeNarrowPhase& make_narrow_phase,
    std::shared_ptr<const model::Model> model);

}  // namespace pbmpi::solver
