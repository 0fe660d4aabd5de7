#include "bullet/objects/joint_loads.h"

#include <algorithm>

namespace pbmpi::bullet {

using model::Joint;
using model::JointKind;
using model::Vec3;

JointLoads::JointLoads(const model::Model& model, const Bodies& bodies, AxisJoints& joints,
                       std::span<const int> measured)
    : model_(&model), bodies_(&bodies), measured_(measured.size()) {
  for (std::size_t i = 0; i < measured_.size(); ++i) {
    measured_[i].joint = measured[i];
    joints[measured[i]].setJointFeedback(&measured_[i].feedback);
  }
}

Vec3 JointLoads::place_from_centre(const Joint& joint) const {
  if (joint.kind != JointKind::slider) return bodies_->to_world(joint.body_a, joint.anchor_a);
  if (joint.body_b == model::no_body) return Vec3::Zero();
  return 0.5 * (vec3((*bodies_)[joint.body_b].getCenterOfMassPosition()) -
                vec3((*bodies_)[joint.body_a].getCenterOfMassPosition()));
}

void JointLoads::note_places() {
  for (Measured& one : measured_)
    one.from_centre = place_from_centre(model_->joints[static_cast<std::size_t>(one.joint)]);
}

const JointLoads::Measured& JointLoads::find(int joint) const {
  return *std::ranges::lower_bound(measured_, joint, {}, &Measured::joint);
}

model::JointForce JointLoads::force(int joint) const {
  const Measured& measured = find(joint);
  model::JointForce force;
  force.force = vec3(measured.feedback.m_appliedForceBodyA);
  force.torque = vec3(measured.feedback.m_appliedTorqueBodyA) - measured.from_centre.cross(force.force);
  return force;
}

effects::Reaction JointLoads::reaction(int joint) const {
  const model::JointForce found = force(joint);
  return {found.force.norm(), found.torque.norm()};
}

}  // namespace pbmpi::bullet
