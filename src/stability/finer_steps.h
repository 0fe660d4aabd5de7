/// A step of a world done as several shorter ones.
#pragma once

#include <cstdint>
#include <memory>

#include "model/model.h"
#include "model/state.h"
#include "stability/on_blowup.h"
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
/// of its own.
FinerResult step_finer(const GuardSettings& settings, int world, const model::Model& model,
                       const model::State& before, std::int64_t step, int finer);

}  // namespace pbmpi::stability
