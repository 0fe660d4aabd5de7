/// Steps worlds with pbmpi's own projected SOR.
#pragma once

#include <memory>

#include "model/contact.h"
#include "model/stepper.h"
#include "solver/simd.h"

namespace pbmpi::solver {

/// Worlds lie side by side in lanes; a world's result depends neither on its neighbours nor on the number of
/// lanes. Throws core::InputError for dt <= 0, iterations or substeps < 1, a warm start outside 0 to 1, or an
/// instruction set that this machine lacks.
std::unique_ptr<model::AnytimeStepper> make_sor_stepper(const model::StepperSettings& settings,
                                                        model::MakeNarrowPhase make_narrow_phase);

}  // namespace pbmpi::solver
