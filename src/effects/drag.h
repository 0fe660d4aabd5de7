/// The effect drag: the air slows bodies down.
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "effects/effects.h"
#include "geometry/measures.h"

namespace pbmpi::effects {

/// k = rho Cd A / (2 m) [1/m] of each body.
inline std::vector<double> drag_factors(const model::Model& model) {
  std::vector<double> factors(model.bodies.size(), 0);
  for (const model::Geom& geom : model.geoms) {
    if (geom.body == model::no_body) continue;
    const auto body = static_cast<std::size_t>(geom.body);
    factors[body] += model.air_density * geometry::drag_area(geom) / (2 * model.bodies[body].mass_kg);
  }
  return factors;
}

/// The force on a centre of mass is -1/2 rho Cd A |v| v, in still air; there is no drag on rotation. In a
/// step v' = v / (1 + k |v| dt), which is implicit in the direction and so never reverses a velocity.
inline VelocityRule make_drag(const model::Model& model) {
  return [factors = drag_factors(model)](double dt_s, std::span<const int> bodies, model::State& state) {
    for (const int body : bodies) {
      const auto index = static_cast<std::size_t>(body);
      if (factors[index] == 0) continue;
      core::Vec3& v = state.velocity[index];
      v /= 1 + factors[index] * v.norm() * dt_s;
    }
  };
}

}  // namespace pbmpi::effects
