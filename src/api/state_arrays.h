/// States of worlds as the contiguous arrays of a batch, and back.
#pragma once

#include "model/state.h"
#include "pbmpi/batch.h"

namespace pbmpi::api {

/// Arrays for so many worlds of so many bodies each.
BatchState make_arrays(int num_worlds, int num_bodies);

/// Throws core::InputError, saying which array is how long, unless `arrays` are as long as make_arrays()'s.
void require_shape(const BatchState& arrays, int num_worlds, int num_bodies);

/// World `index` of the arrays.
void put(const model::State& state, int index, BatchState& arrays);

/// Poses and velocities of world `index` of the arrays; all else stays. Throws core::InputError, naming world
/// `id` and the body, for a number that is not finite, and an orientation whose length is not 1.
void take(const BatchState& arrays, int index, int id, const model::Model& model, model::State& state);

}  // namespace pbmpi::api
