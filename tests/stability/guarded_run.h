/// Guarded worlds in a stepper, for tests of what guards do.
#pragma once

#include <memory>
#include <vector>

#include "stability/guarded_stepper.h"

namespace pbmpi::stability {

/// quick or sor, depending on `settings.kind`; its messages are discarded.
std::unique_ptr<stepping::WorldStepper> make_any_stepper(const stepping::StepperSettings& settings);

/// A stepper with these worlds, ids 0, 1, ..., from their start.
std::unique_ptr<GuardedStepper> make_guarded(const std::vector<model::Model>& worlds,
                                             const stepping::StepperSettings& settings, OnBlowup on_blowup);

/// Runs frames of three steps; returns their events.
std::vector<stepping::RunEvent> run_frames(GuardedStepper& stepper, int num_frames);

}  // namespace pbmpi::stability
