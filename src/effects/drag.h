/// The effect drag: the air slows bodies down.
#pragma once

#include <numbers>
#include <span>
#include <utility>
#include <vector>

#include "effects/effects.h"

namespace pbmpi::effects {

/// Cd A [m^2] of a geom, as if it were its body's only geom and nothing stood near.
///
/// A is the mean area of a convex body's shadow over all directions: a quarter of its surface (Cauchy), since
/// a tumbling body shows all its sides. Cd at Re of 1e4 to 2e5: sphere 0.47 and cube 1.05 from S. F. Hoerner,
/// Fluid-Dynamic Drag (1965), chapter III; cylinder 0.82 (ten diameters long, side on) from C. Matthews,
/// Aeronautical Engineer's Data Book (2002), chapter 5. A capsule is taken as round as a sphere.
inline double drag_area(const model::Geom& geom) {
  constexpr double cd_round = 0.47, cd_box = 1.05, cd_cylinder = 0.82, pi = std::numbers::pi;
  const auto& [a, b, c] = geom.size;
  switch (geom.shape) {
    case model::Shape::sphere:
      return cd_round * pi * a * a;
    case model::Shape::capsule:
      return cd_round * pi * a * (a + b / 2);
    case model::Shape::cylinder:
      return cd_cylinder * pi * a * (a + b) / 2;
    case model::Shape::box:
      return cd_box * (a * b + b * c + c * a) / 2;
    case model::Shape::plane:
      break;
  }
  return 0;
}

/// k = rho Cd A / (2 m) [1/m] of each body.
inline std::vector<double> drag_factors(const model::Model& model) {
  std::vector<double> factors(model.bodies.size(), 0);
  for (const model::Geom& geom : model.geoms) {
    if (geom.body == model::no_body) continue;
    const auto body = static_cast<std::size_t>(geom.body);
    factors[body] += model.air_density * drag_area(geom) / (2 * model.bodies[body].mass_kg);
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
