#include "model/joint_gap.h"

#include <algorithm>

#include "model/joint_traits.h"

namespace pbmpi::model {
namespace {

Pose pose_of(const State& state, int body) {
  return body == no_body ? Pose{} : Pose{state.position[body], state.orientation[body]};
}

Pose start_of(const Model& model, int body) { return body == no_body ? Pose{} : model.bodies[body].pose; }

/// The point that a joint holds, in the frames of its two bodies [m].
struct HeldPoint {
  Vec3 in_a, in_b;
};

HeldPoint held_point(const Model& model, const Joint& joint) {
  if (traits_of(joint.kind).has_anchor()) return {joint.anchor_a, joint.anchor_b};
  const Pose a = start_of(model, joint.body_a), b = start_of(model, joint.body_b);
  if (joint.body_b == no_body) return {Vec3::Zero(), a.position};  // b's frame is the world's
  return {a.orientation.to_eigen().conjugate() * (b.position - a.position), Vec3::Zero()};
}

}  // namespace

Vec3 joint_gap_vector(const Model& model, const Joint& joint, const Pose& a, const Pose& b) {
  const HeldPoint held = held_point(model, joint);
  Vec3 gap = a.point_to_outer(held.in_a) - b.point_to_outer(held.in_b);
  if (moves_along_axis(joint)) {
    const Vec3 axis = a.direction_to_outer(joint.axis1_a);
    gap -= axis * axis.dot(gap);
  }
  return gap;
}

Vec3 joint_gap_vector_in_a(const Model& model, const Joint& joint, const Pose& a, const Pose& b) {
  const HeldPoint held = held_point(model, joint);
  Vec3 gap = held.in_a - a.orientation.to_eigen().conjugate() * (b.point_to_outer(held.in_b) - a.position);
  if (moves_along_axis(joint)) gap -= joint.axis1_a * joint.axis1_a.dot(gap);
  return gap;
}

double joint_gap(const Model& model, const State& state, const Joint& joint) {
  return joint_gap_vector(model, joint, pose_of(state, joint.body_a), pose_of(state, joint.body_b)).norm();
}

double max_joint_gap(const Model& model, const State& state) {
  double gap = 0;
  for (std::size_t i = 0; i < model.joints.size(); ++i) {
    if (!state.is_broken(i)) gap = std::max(gap, joint_gap(model, state, model.joints[i]));
  }
  return gap;
}

}  // namespace pbmpi::model
