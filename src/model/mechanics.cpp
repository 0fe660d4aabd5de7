#include "model/mechanics.h"

namespace pbmpi::model {
namespace {

/// The angular velocity and momentum of a body in its own frame.
struct Spin {
  Vec3 velocity, momentum;
};

inline Spin spin_of(const Mat3& inertia, const Eigen::Quaterniond& orientation,
                    const Vec3& angular_velocity) {
  const Vec3 velocity = orientation.conjugate() * angular_velocity;
  return {velocity, inertia * velocity};
}

inline double energy_of(double mass_kg, const Spin& spin, const Vec3& velocity, const Vec3& gravity,
                        const Vec3& position) {
  return 0.5 * mass_kg * velocity.squaredNorm() + 0.5 * spin.velocity.dot(spin.momentum) -
         mass_kg * gravity.dot(position);
}

}  // namespace

MechanicsMeter::MechanicsMeter(const Model& model) : gravity_(model.gravity) {
  masses_.reserve(model.bodies.size());
  for (const Body& body : model.bodies) masses_.push_back({body.mass_kg, body.inertia});
}

Mechanics MechanicsMeter::measure(const State& state) const {
  Mechanics sum;
  for (std::size_t i = 0; i < masses_.size(); ++i) {
    const Mass& mass = masses_[i];
    const Vec3& position = state.position[i];
    const Vec3& velocity = state.velocity[i];
    const Eigen::Quaterniond orientation = state.orientation[i].to_eigen();
    const Spin spin = spin_of(mass.inertia, orientation, state.angular_velocity[i]);
    sum.energy_j += energy_of(mass.kg, spin, velocity, gravity_, position);
    sum.linear_momentum += mass.kg * velocity;
    sum.angular_momentum += orientation * spin.momentum + mass.kg * position.cross(velocity);
  }
  return sum;
}

double body_energy(const Model& model, const State& state, int index) {
  const Body& body = model.bodies[index];
  const Spin spin = spin_of(body.inertia, state.orientation[index].to_eigen(), state.angular_velocity[index]);
  return energy_of(body.mass_kg, spin, state.velocity[index], model.gravity, state.position[index]);
}

double mechanical_energy(const Model& model, const State& state) {
  return MechanicsMeter(model).measure(state).energy_j;
}

Vec3 linear_momentum(const Model& model, const State& state) {
  return MechanicsMeter(model).measure(state).linear_momentum;
}

Vec3 angular_momentum(const Model& model, const State& state) {
  return MechanicsMeter(model).measure(state).angular_momentum;
}

}  // namespace pbmpi::model
