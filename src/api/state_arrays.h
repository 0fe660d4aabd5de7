/// States of worlds as the contiguous arrays of a batch, and back.
#pragma once

#include "model/state.h"
#include "pbmpi/batch.h"

namespace pbmpi::api {

/// Arrays for `num_worlds` worlds of `num_bodies` bodies each.
BatchState make_arrays(int num_worlds, int num_bodies);

/// Throws core::InputError, saying which array is how long, unless `arrays` are as long as make_arrays()'s.
void require_shape(const BatchState& arrays, int num_worlds, int num_bodies);

/// Writes a state to world `index` of the arrays.
void put(const model::State& state, int index, BatchState& arrays);

/// Reads poses and velocities from world `index` of the arrays; the rest of `state` stays. Throws
/// core::InputError, naming world `id` and the body, for a number that is not finite, and an orientation
/// whose length is not 1.
void take(const BatchState& arrays, int index, int id, const model::Model& model, model::State& state);

}  // namespace pbmpi::api
