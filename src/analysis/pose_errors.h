/// The distance between two results for the same bodies: body by body and joint by joint.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "model/state.h"

namespace pbmpi::analysis {

/// Poses of the bodies of one world [num_bodies]; borrowed.
struct PoseView {
  std::span<const model::Vec3> position;     ///< m, world frame
  std::span<const model::Quat> orientation;  ///< (w, x, y, z), of any length except zero
  /// As in model::State: broken joints, which hold nothing; empty: all joints hold.
  std::span<const std::int32_t> broken_in = {};

  bool holds(std::size_t joint) const { return broken_in.empty() || broken_in[joint] == model::unbroken; }
  /// Pose of a body; the world frame for no body.
  model::Pose pose(int body) const {
    if (body == model::no_body) return {};
    return {position[static_cast<std::size_t>(body)], orientation[static_cast<std::size_t>(body)]};
  }
};

/// Gap of a joint: model::joint_gap_vector_in_a() for two poses of the view [m].
model::Vec3 joint_gap_vector_in_a(const model::Model& model, const model::Joint& joint, PoseView poses);

/// Angle [rad, 0 to pi] of the shortest rotation between two orientations; q and -q are the same orientation.
/// NaN if a component is NaN.
double rotation_angle(const model::Quat& a, const model::Quat& b);

/// The angle [rad] by which a joint is bent about axes that it locks. ball: 0 (nothing is held). hinge:
/// between the two bodies' hinge axes. universal, hinge2: change of the angle between axis 1 and axis 2.
/// slider, fixed: rotation from the start.
double joint_axis_angle(const model::Model& model, const model::Joint& joint, PoseView poses);

/// Errors of every body and of every joint of a world; the number of entries does not depend on the method. A
/// joint that is broken in either result has no position or orientation error; it counts as broken. An entry
/// that cannot be computed is NaN.
struct PoseErrors {
  std::vector<double> body_position_m;        ///< [num_bodies] distance
  std::vector<double> body_orientation_rad;   ///< [num_bodies] angle
  std::vector<double> joint_position_m;       ///< [joints that hold] distance of the two gap vectors
  std::vector<double> joint_orientation_rad;  ///< [joints that hold] difference of the two axis angles
  std::vector<std::size_t> joints;            ///< [joints that hold] their indices
  std::int64_t broken_joints = 0;             ///< all others

  void append(const PoseErrors& more);
};

/// Bodies alone: no entries for joints.
PoseErrors compare_bodies(PoseView poses, PoseView reference);

PoseErrors compare(const model::Model& model, PoseView poses, PoseView reference);

}  // namespace pbmpi::analysis
