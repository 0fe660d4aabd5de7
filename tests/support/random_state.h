/// States that no solver would produce.
#pragma once

#include <cstdint>

#include "model/model.h"
#include "model/state.h"

namespace pbmpi::support {

/// Positions [m] and velocities [m/s, rad/s] from -1 to 1 and any orientation, regardless of the model's
/// joints. Equal for equal seeds.
model::State random_state(const model::Model& model, std::uint64_t seed);

}  // namespace pbmpi::support
