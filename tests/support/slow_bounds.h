/// Speed bounds (effects/fast_bodies.h) of a model at its start.
#pragma once

#include <vector>

#include "effects/fast_bodies.h"

namespace pbmpi::support {

inline bool keeps_slow_bounds(const model::Model& model, double dt_s) {
  const std::vector<effects::SlowBound> bounds = effects::slow_bounds(model);
  for (std::size_t body = 0; body < bounds.size(); ++body) {
    const model::Body& moving = model.bodies[body];
    if (!bounds[body].holds(moving.velocity, moving.angular_velocity, dt_s)) return false;
  }
  return true;
}

}  // namespace pbmpi::support
