/// A world's whole state as one array of numbers, which begins with its own lengths.
#pragma once

#include <span>
#include <vector>

#include "model/state.h"

namespace pbmpi::mpi {

/// Packs a state with every bit kept, also the payload of a NaN.
std::vector<double> pack(const model::State& state);

/// Inverse of pack(). Throws core::RunError unless `packed` is as long as its lengths say.
model::State unpack(std::span<const double> packed);

/// Throws core::RunError unless a state of `world` has a row for each body of its model.
void require_rows(int world, const model::State& state, const model::Model& model);
/// Throws what require_rows() throws. Also throws core::RunError unless State::broken_in and the memory's
/// joints, if there are any, have an entry for each joint of the model, and the model has the geoms and
/// bodies that contact forces act on.
void require_fit(int world, const model::State& state, const model::Model& model);

}  // namespace pbmpi::mpi
