/// Steps worlds with pbmpi's own projected SOR.
#pragma once

#include <memory>

#include "model/contact.h"
#include "solver/pack/simd.h"
#include "stepping/stepper.h"

namespace pbmpi::solver {

/// Worlds lie side by side in lanes; a world's result depends neither on its neighbours nor on the numbers of
/// lanes and threads. With StepperSettings::threads above 1 groups of worlds are stepped at the same time, in
/// advance(); the caller's thread does everything else. Throws core::InputError for dt <= 0, iterations or
/// substeps < 1, a warm start outside 0 to 1, or an instruction set that this machine or build lacks.
std::unique_ptr<stepping::WorldStepper> make_sor_stepper(const stepping::StepperSettings& settings,
                                                         model::MakeNarrowPhase make_narrow_phase);

}  // namespace pbmpi::solver
