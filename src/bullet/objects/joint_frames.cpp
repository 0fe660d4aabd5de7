#include "bullet/objects/joint_frames.h"

#include "core/error.h"
#include "model/joint_traits.h"

namespace pbmpi::bullet {
namespace {

using model::Mat3;
using model::Vec3;

constexpr double least_sine_between_axes = 0.1;  // 6 degrees; the cross product is the constrained direction

Mat3 from_columns(const Vec3& x, const Vec3& y, const Vec3& z) {
  Mat3 matrix;
  matrix << x, y, z;
  return matrix;
}

btTransform to_transform(const Mat3& m, const Vec3& origin) {
  return btTransform(
      btMatrix3x3(m(0, 0), m(0, 1), m(0, 2), m(1, 0), m(1, 1), m(1, 2), m(2, 0), m(2, 1), m(2, 2)),
      to_bullet(origin));
}

/// The frame of an anchor and two directions, relative to a body at `pose`.
btTransform seen_from(const model::Pose& pose, const Mat3& turn, const Vec3& anchor) {
  const Mat3 rotation = pose.orientation.to_eigen().toRotationMatrix();
  return to_transform(rotation.transpose() * turn, anchor);
}

/// The anchors in the frames of the two bodies [m]: the joint's own, or, for kinds that have none, the centre
/// of mass of the first body (slider) or of the second (fixed).
struct Anchors {
  Vec3 a, b;
};

Anchors anchors_of(const model::Joint& joint, const model::Pose& a, const model::Pose& b) {
  const model::JointTraits& traits = model::traits_of(joint.kind);
  if (traits.has_anchor()) return {joint.anchor_a, joint.anchor_b};
  const auto seen_from = [](const model::Pose& pose, const Vec3& point) {
    return Vec3(pose.orientation.to_eigen().conjugate() * (point - pose.position));
  };
  if (traits.place == model::HeldPlace::line || joint.body_b == model::no_body)
    return {Vec3::Zero(), seen_from(b, a.position)};
  return {seen_from(a, b.position), Vec3::Zero()};
}

}  // namespace

JointFrames frames_of(const model::Model& model, const model::Joint& joint, const Bodies& bodies) {
  const model::JointTraits& traits = model::traits_of(joint.kind);
  const auto pose_of = [&](int body) {
    return body == model::no_body ? model::Pose{} : model.bodies[static_cast<std::size_t>(body)].pose;
  };
  const model::Pose a = pose_of(joint.body_a), b = pose_of(joint.body_b);
  Vec3 z = traits.num_axes > 0 ? a.direction_to_outer(joint.axis1_a) : Vec3(Vec3::UnitZ());
  if (traits.slides) z = -z;
  Vec3 y = z.unitOrthogonal();
  Vec3 x_of_b = y.cross(z);
  if (traits.num_axes == 2) {
    x_of_b = b.direction_to_outer(joint.axis2_b);
    y = z.cross(x_of_b);
    core::require_input(y.norm() > least_sine_between_axes,
                        "joint '" + joint.name + "': its two axes are parallel; turn one of them");
    y.normalize();
  }
  const Anchors anchors = anchors_of(joint, a, b);
  const btTransform in_a = seen_from(a, from_columns(y.cross(z), y, z), anchors.a);
  const btTransform in_b = seen_from(b, from_columns(x_of_b, y, x_of_b.cross(y)), anchors.b);
  return {bodies.local(joint.body_a, in_a), bodies.local(joint.body_b, in_b)};
}

}  // namespace pbmpi::bullet
