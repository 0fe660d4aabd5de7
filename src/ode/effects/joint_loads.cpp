#include "ode/effects/joint_loads.h"

#include <algorithm>

namespace pbmpi::ode {

using model::Joint;
using model::JointKind;
using model::Vec3;

namespace {

Vec3 to_world(dBodyID body, const Vec3& local) {
  dVector3 turned;
  dBodyVectorToWorld(body, local.x(), local.y(), local.z(), turned);
  return vec3(turned);
}

}  // namespace

JointLoads::JointLoads(const model::Model& model, const std::vector<dJointID>& joints,
                       std::span<const int> measured)
    : model_(&model), joints_(joints), measured_(measured.size()) {
  for (std::size_t i = 0; i < measured_.size(); ++i) {
    measured_[i].joint = measured[i];
    dJointSetFeedback(joints_[measured[i]], &measured_[i].feedback);
  }
}

Vec3 JointLoads::place_from_centre(const Joint& joint, dJointID id) const {
  const dBodyID a = dJointGetBody(id, 0), b = dJointGetBody(id, 1);
  if (joint.kind != JointKind::slider) return to_world(a, joint.anchor_a);
  return b == nullptr ? Vec3::Zero() : Vec3(0.5 * (vec3(dBodyGetPosition(b)) - vec3(dBodyGetPosition(a))));
}

void JointLoads::note_places() {
  for (Measured& one : measured_)
    one.from_centre = place_from_centre(model_->joints[one.joint], joints_[one.joint]);
}

const JointLoads::Measured& JointLoads::find(int joint) const {
  return *std::ranges::lower_bound(measured_, joint, {}, &Measured::joint);
}

model::JointForce JointLoads::force(int joint) const {
  const Measured& measured = find(joint);
  model::JointForce force;
  force.force = vec3(measured.feedback.f1);
  force.torque = vec3(measured.feedback.t1) - measured.from_centre.cross(force.force);
  return force;
}

/// The torque of a fixed joint is taken at the pose of its first body after the step.
effects::Reaction JointLoads::reaction(int joint) const {
  const Measured& found = find(joint);
  const Joint& measured = model_->joints[joint];
  const Vec3 from_centre =
      measured.kind == JointKind::fixed ? place_from_centre(measured, joints_[joint]) : found.from_centre;
  const Vec3 force = vec3(found.feedback.f1), torque = vec3(found.feedback.t1);
  return {force.norm(), (torque - from_centre.cross(force)).norm()};
}

}  // namespace pbmpi::ode
