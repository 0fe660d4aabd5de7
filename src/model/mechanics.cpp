#include "model/mechanics.h"

namespace pbmpi::model {

double body_energy(const Model& model, const State& state, int index) {
  const Body& body = model.bodies[index];
  const Vec3 omega_local = state.orientation[index].to_eigen().conjugate() * state.angular_velocity[index];
  return 0.5 * body.mass_kg * state.velocity[index].squaredNorm() +
         0.5 * omega_local.dot(body.inertia * omega_local) -
         body.mass_kg * model.gravity.dot(state.position[index]);
}

double mechanical_energy(const Model& model, const State& state) {
  double energy = 0;
  for (int body = 0; body < model.num_bodies(); ++body) energy += body_energy(model, state, body);
  return energy;
}

Vec3 linear_momentum(const Model& model, const State& state) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 0; i < model.bodies.size(); ++i) sum += model.bodies[i].mass_kg * state.velocity[i];
  return sum;
}

Vec3 angular_momentum(const Model& model, const State& state) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 0; i < model.bodies.size(); ++i) {
    const auto q = state.orientation[i].to_eigen();
    const Vec3 spin = q * (model.bodies[i].inertia * (q.conjugate() * state.angular_velocity[i]));
    sum += spin + model.bodies[i].mass_kg * state.position[i].cross(state.velocity[i]);
  }
  return sum;
}

}  // namespace pbmpi::model
