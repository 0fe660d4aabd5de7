/// A world's state as it travels whole: one run of numbers that says its own lengths.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "model/state.h"

namespace pbmpi::mpi {

/// Numbers of a packed state with as many rows as this one.
std::int64_t packed_size(const model::State& state);

/// Bit for bit: what a NaN carries survives, too.
std::vector<double> pack(const model::State& state);

/// Throws core::RunError if the lengths do not fit.
model::State unpack(std::span<const double> packed);

/// Throws core::RunError unless a state of `world` has a row for each body of its model.
void require_rows(int world, const model::State& state, const model::Model& model);
/// The same for the joints, too.
void require_fit(int world, const model::State& state, const model::Model& model);

}  // namespace pbmpi::mpi
