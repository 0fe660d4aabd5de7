#include "model/mechanics.h"

#include <cmath>

#include "model/joint_traits.h"

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
  for (const Joint& joint : model.joints) {
    if (joint.armature[0] > 0 || joint.armature[1] > 0) rotors_.push_back(joint);
  }
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
  for (const Joint& joint : rotors_) {
    for (int axis = 0; axis < 2; ++axis) {
      const double inertia = joint.armature[static_cast<std::size_t>(axis)];
      if (!(inertia > 0)) continue;
      const double speed = axis_speed(state, joint, axis);
      sum.energy_j += 0.5 * inertia * speed * speed;
    }
  }
  return sum;
}

double axis_speed(const State& state, const Joint& joint, int axis) {
  const auto turned = [&](int body, const Vec3& direction) -> Vec3 {
    return body == no_body ? direction : state.orientation[body].to_eigen() * direction;
  };
  const bool has_b = joint.body_b != no_body;
  const Vec3 turning_b = has_b ? state.angular_velocity[joint.body_b] : Vec3(Vec3::Zero());
  const Vec3 direction =
      axis == 0 ? turned(joint.body_a, joint.axis1_a) : turned(joint.body_b, joint.axis2_b);
  const Vec3& turning_a = state.angular_velocity[joint.body_a];
  if (!traits_of(joint.kind).slides) return direction.dot(turning_a - turning_b);
  // The bodies slide past each other midway between their centres.
  const Vec3 velocity_b = has_b ? state.velocity[joint.body_b] : Vec3(Vec3::Zero());
  const Vec3 arm =
      has_b ? Vec3((state.position[joint.body_b] - state.position[joint.body_a]) / 2) : Vec3(Vec3::Zero());
  return direction.dot(state.velocity[joint.body_a] + turning_a.cross(arm) - velocity_b +
                       turning_b.cross(arm));
}

std::vector<Mat3> inertias_with_armatures(const Model& model) {
  std::vector<Mat3> inertias;
  inertias.reserve(model.bodies.size());
  for (const Body& body : model.bodies) inertias.push_back(body.inertia);
  const auto add = [&](int body, double armature, const Vec3& axis) {
    if (body != no_body && armature > 0)
      inertias[static_cast<std::size_t>(body)] += armature * axis * axis.transpose();
  };
  for (const Joint& joint : model.joints) {
    if (traits_of(joint.kind).slides) continue;
    add(joint.body_a, joint.armature[0], joint.axis1_a);
    add(joint.body_b, joint.armature[1], joint.axis2_b);
  }
  return inertias;
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
