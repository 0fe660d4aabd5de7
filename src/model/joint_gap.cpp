#include "model/joint_gap.h"

#include <algorithm>
#include <cmath>

#include "model/joint_traits.h"

namespace pbmpi::model {
namespace {

Pose start_of(const Model& model, int body) { return body == no_body ? Pose{} : model.bodies[body].pose; }

HeldPoint held_point(const Model& model, const Joint& joint) {
  HeldPoint held{.body_a = joint.body_a,
                 .body_b = joint.body_b,
                 .slides = moves_along_axis(joint),
                 .in_a = joint.anchor_a,
                 .in_b = joint.anchor_b,
                 .axis = joint.axis1_a};
  if (traits_of(joint.kind).has_anchor()) return held;
  const Pose a = start_of(model, joint.body_a), b = start_of(model, joint.body_b);
  const bool is_in_world = joint.body_b == no_body;  // b's frame is the world's
  held.in_a =
      is_in_world ? Vec3::Zero() : Vec3(a.orientation.to_eigen().conjugate() * (b.position - a.position));
  held.in_b = is_in_world ? a.position : Vec3::Zero();
  return held;
}

inline Vec3 gap_vector(const HeldPoint& held, const Pose& a, const Pose& b) {
  Vec3 gap = a.point_to_outer(held.in_a) - b.point_to_outer(held.in_b);
  if (held.slides) {
    const Vec3 axis = a.direction_to_outer(held.axis);
    gap -= axis * axis.dot(gap);
  }
  return gap;
}

}  // namespace

Vec3 joint_gap_vector(const Model& model, const Joint& joint, const Pose& a, const Pose& b) {
  return gap_vector(held_point(model, joint), a, b);
}

Vec3 joint_gap_vector_in_a(const Model& model, const Joint& joint, const Pose& a, const Pose& b) {
  const HeldPoint held = held_point(model, joint);
  Vec3 gap = held.in_a - a.orientation.to_eigen().conjugate() * (b.point_to_outer(held.in_b) - a.position);
  if (held.slides) gap -= held.axis * held.axis.dot(gap);
  return gap;
}

double joint_gap(const Model& model, const State& state, const Joint& joint) {
  return joint_gap_vector(model, joint, state.pose(joint.body_a), state.pose(joint.body_b)).norm();
}

JointGaps::JointGaps(const Model& model) {
  held_.reserve(model.joints.size());
  for (const Joint& joint : model.joints) held_.push_back(held_point(model, joint));
}

/// One root suffices: the root of the largest square is the largest length, to the bit.
double JointGaps::largest(const State& state) const {
  double square = 0;
  for (std::size_t i = 0; i < held_.size(); ++i) {
    if (state.is_broken(i)) continue;
    const HeldPoint& held = held_[i];
    const Vec3 gap = gap_vector(held, state.pose(held.body_a), state.pose(held.body_b));
    square = std::max(square, gap.squaredNorm());
  }
  return std::sqrt(square);
}

double max_joint_gap(const Model& model, const State& state) { return JointGaps(model).largest(state); }

}  // namespace pbmpi::model
