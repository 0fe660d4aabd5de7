#include "analysis/pose_errors.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "model/joint_gap.h"
#include "model/joint_traits.h"

namespace pbmpi::analysis {

using core::Pose;
using core::Quat;
using core::Vec3;
using model::Joint;
using model::Model;

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

Pose start_of(const Model& model, int body) {
  return body == model::no_body ? Pose{} : model.bodies[static_cast<std::size_t>(body)].pose;
}

/// Angle between two directions [rad]; exact for small angles, where acos loses half the digits.
double angle_between(const Vec3& a, const Vec3& b) { return std::atan2(a.cross(b).norm(), a.dot(b)); }

/// `direction`, given in the frame of a, in the frame of b, with both bodies as they stood at the start.
Vec3 at_start_in_b(const Model& model, const Joint& joint, const Vec3& direction) {
  const Pose a = start_of(model, joint.body_a), b = start_of(model, joint.body_b);
  return b.orientation.to_eigen().conjugate() * a.direction_to_outer(direction);
}

/// Zero for a finite pose, otherwise NaN. Added to an angle that depends on a part of the pose only, it makes
/// a NaN in the rest visible.
double poison(const Pose& pose) {
  const Quat& q = pose.orientation;
  return 0 * (pose.position.sum() + q.w + q.x + q.y + q.z);
}

double distance(const Vec3& a, const Vec3& b) {
  const Vec3 difference = a - b;
  return difference.allFinite() ? difference.norm() : nan;
}

}  // namespace

double rotation_angle(const Quat& a, const Quat& b) {
  const Eigen::Quaterniond turn = a.to_eigen().conjugate() * b.to_eigen();
  const double angle = 2 * std::atan2(turn.vec().norm(), std::abs(turn.w()));
  return std::isfinite(turn.coeffs().sum()) ? angle : nan;
}

Vec3 joint_gap_vector_in_a(const Model& model, const Joint& joint, PoseView poses) {
  return model::joint_gap_vector_in_a(model, joint, poses.pose(joint.body_a), poses.pose(joint.body_b));
}

double joint_axis_angle(const Model& model, const Joint& joint, PoseView poses) {
  const Pose a = poses.pose(joint.body_a), b = poses.pose(joint.body_b);
  const Vec3 axis1 = a.direction_to_outer(joint.axis1_a);
  const double spoilt = poison(a) + poison(b);
  switch (model::traits_of(joint.kind).turn) {
    case model::HeldTurn::nothing:
      return spoilt;
    case model::HeldTurn::axis:
      return spoilt + angle_between(axis1, b.direction_to_outer(at_start_in_b(model, joint, joint.axis1_a)));
    case model::HeldTurn::right_angle:
    case model::HeldTurn::start_angle: {
      const double now = angle_between(axis1, b.direction_to_outer(joint.axis2_b));
      const double start = angle_between(at_start_in_b(model, joint, joint.axis1_a), joint.axis2_b);
      return spoilt + std::abs(now - start);
    }
    case model::HeldTurn::orientation: {
      const auto start = start_of(model, joint.body_a).orientation.to_eigen().conjugate() *
                         start_of(model, joint.body_b).orientation.to_eigen();
      const auto now = a.orientation.to_eigen().conjugate() * b.orientation.to_eigen();
      return rotation_angle(Quat::from_eigen(start), Quat::from_eigen(now));
    }
  }
  return nan;
}

void PoseErrors::append(const PoseErrors& more) {
  const auto add = [](std::vector<double>& to, const std::vector<double>& from) {
    to.insert(to.end(), from.begin(), from.end());
  };
  add(body_position_m, more.body_position_m);
  add(body_orientation_rad, more.body_orientation_rad);
  add(joint_position_m, more.joint_position_m);
  add(joint_orientation_rad, more.joint_orientation_rad);
  joints.insert(joints.end(), more.joints.begin(), more.joints.end());
  broken_joints += more.broken_joints;
}

PoseErrors compare_bodies(PoseView poses, PoseView reference) {
  PoseErrors errors;
  for (std::size_t i = 0; i < reference.position.size(); ++i) {
    errors.body_position_m.push_back(distance(poses.position[i], reference.position[i]));
    errors.body_orientation_rad.push_back(rotation_angle(poses.orientation[i], reference.orientation[i]));
  }
  return errors;
}

PoseErrors compare(const Model& model, PoseView poses, PoseView reference) {
  PoseErrors errors = compare_bodies(poses, reference);
  for (std::size_t i = 0; i < model.joints.size(); ++i) {
    if (!poses.holds(i) || !reference.holds(i)) {
      ++errors.broken_joints;
      continue;
    }
    const Joint& joint = model.joints[i];
    errors.joints.push_back(i);
    errors.joint_position_m.push_back(
        distance(joint_gap_vector_in_a(model, joint, poses), joint_gap_vector_in_a(model, joint, reference)));
    errors.joint_orientation_rad.push_back(
        std::abs(joint_axis_angle(model, joint, poses) - joint_axis_angle(model, joint, reference)));
  }
  return errors;
}

}  // namespace pbmpi::analysis
