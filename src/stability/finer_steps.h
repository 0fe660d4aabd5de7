/// Does a step of a world as several shorter ones.
#pragma once

#include <cstdint>
#include <memory>

#include "model/model.h"
#include "model/state.h"
#include "stability/on_blowup.h"
#include "stepping/motor_targets.h"
#include "stepping/observables.h"

namespace pbmpi::stability {

/// The model with the step numbers of its events converted to steps that are `finer` times as short.
model::Model in_finer_steps(const model::Model& model, int finer);

/// Converts a state to a run with steps `finer` times as short, and back: broken joints and idle counters are
/// in steps. Joints that were broken before keep their step, which comes from `before`. Remembered quantities
/// are forces, and need no change.
model::State to_finer_steps(model::State state, int finer);
model::State from_finer_steps(model::State state, int finer, const model::State& before);

/// The result of a step that was done in finer ones.
struct FinerResult {
  model::State state;
  stepping::Observables seen;
};

/// Does step `step` of a world from `before` as `finer` steps of dt / finer, each with its own collision
/// detection. `targets`: those of its motors.
FinerResult step_finer(const GuardSettings& settings, int world, const model::Model& model,
                       const stepping::MotorTargets& targets, const model::State& before, std::int64_t step,
                       int finer);

/// Adds a world to a stepper, with the targets of its motors.
void add_aimed(stepping::WorldStepper& stepper, int world, std::shared_ptr<const model::Model> model,
               const stepping::MotorTargets& targets, const model::State& state, std::int64_t step);

}  // namespace pbmpi::stability
