/// A step of a world done as several shorter ones.
#pragma once

#include <cstdint>
#include <memory>

#include "model/model.h"
#include "model/state.h"
#include "stability/on_blowup.h"
#include "stepping/motor_targets.h"
#include "stepping/observables.h"

namespace pbmpi::stability {

/// The model with the step numbers of its events in steps that are `finer` times as short.
model::Model in_finer_steps(const model::Model& model, int finer);

/// A state as a run with steps `finer` times as short has it, and back: broken joints and idle steps count
/// steps. Joints that were broken before keep their step, which comes from `before`. What is remembered are
/// forces, and needs no change.
model::State to_finer_steps(model::State state, int finer);
model::State from_finer_steps(model::State state, int finer, const model::State& before);

/// What a step has become.
struct FinerResult {
  model::State state;
  stepping::Observables seen;
};

/// Does step `step` of a world from `before` on as `finer` steps of dt / finer, each with collision detection
/// of its own. `targets`: what its motors aim at.
FinerResult step_finer(const GuardSettings& settings, int world, const model::Model& model,
                       const stepping::MotorTargets& targets, const model::State& before, std::int64_t step,
                       int finer);

/// Adds a world to a stepper, with the targets of its motors.
void add_aimed(stepping::WorldStepper& stepper, int world, std::shared_ptr<const model::Model> model,
               const stepping::MotorTargets& targets, const model::State& state, std::int64_t step);

}  // namespace pbmpi::stability
