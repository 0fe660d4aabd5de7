#include "stepping/observables.h"

#include <algorithm>

namespace pbmpi::stepping {
namespace {

core::Pose pose_of(const model::State& state, int body) {
  return body == model::no_body ? core::Pose{} : core::Pose{state.position[body], state.orientation[body]};
}

}  // namespace

double body_energy(const model::Model& model, const model::State& state, int index) {
  const model::Body& body = model.bodies[index];
  const core::Vec3 omega_local =
      state.orientation[index].to_eigen().conjugate() * state.angular_velocity[index];
  return 0.5 * body.mass_kg * state.velocity[index].squaredNorm() +
         0.5 * omega_local.dot(body.inertia * omega_local) -
         body.mass_kg * model.gravity.dot(state.position[index]);
}

double mechanical_energy(const model::Model& model, const model::State& state) {
  double energy = 0;
  for (int body = 0; body < model.num_bodies(); ++body) energy += body_energy(model, state, body);
  return energy;
}

double joint_gap(const model::Model& model, const model::State& state, const model::Joint& joint) {
  const core::Pose a = pose_of(state, joint.body_a);
  const core::Pose b = pose_of(state, joint.body_b);
  core::Vec3 gap;
  if (joint.kind == model::JointKind::slider || joint.kind == model::JointKind::fixed) {
    // These two hold the offset that the bodies had at the start, as seen from a.
    const core::Pose start_a = model.bodies[joint.body_a].pose;
    const core::Pose start_b =
        joint.body_b == model::no_body ? core::Pose{} : model.bodies[joint.body_b].pose;
    const core::Vec3 offset =
        start_a.orientation.to_eigen().conjugate() * (start_b.position - start_a.position);
    gap = joint.body_b == model::no_body ? core::Vec3(a.position - start_a.position)
                                         : core::Vec3(a.point_to_outer(offset) - b.position);
  } else {
    gap = a.point_to_outer(joint.anchor_a) - b.point_to_outer(joint.anchor_b);
  }
  const bool slides = joint.kind == model::JointKind::slider ||
                      (joint.kind == model::JointKind::hinge2 && joint.suspension.stiffness > 0);
  if (slides) {
    const core::Vec3 axis = a.direction_to_outer(joint.axis1_a);
    gap -= axis * axis.dot(gap);
  }
  return gap.norm();
}

double max_joint_gap(const model::Model& model, const model::State& state) {
  double gap = 0;
  for (std::size_t i = 0; i < model.joints.size(); ++i) {
    if (!state.is_broken(i)) gap = std::max(gap, joint_gap(model, state, model.joints[i]));
  }
  return gap;
}

}  // namespace pbmpi::stepping
