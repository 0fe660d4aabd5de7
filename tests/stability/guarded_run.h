/// Watched worlds in a stepper, for tests that look at what guards do.
#pragma once

#include <memory>
#include <vector>

#include "stability/guarded_stepper.h"

namespace pbmpi::stability {

/// quick or sor, as `settings.kind` says; its messages go nowhere.
std::unique_ptr<stepping::WorldStepper> make_any_stepper(const stepping::StepperSettings& settings);

/// These worlds, ids 0, 1, ..., from their start.
std::unique_ptr<GuardedStepper> make_guarded(const std::vector<model::Model>& worlds,
                                             const stepping::StepperSettings& settings, OnBlowup on_blowup);

/// Frames of three steps; returns their events.
std::vector<stepping::RunEvent> run_frames(GuardedStepper& stepper, int num_frames);

}  // namespace pbmpi::stability
