#include "analysis/invariants.h"

#include <cmath>
#include <limits>

#include "model/joint_traits.h"

namespace pbmpi::analysis {

using core::Pose;
using core::Vec3;
using model::Joint;
using model::Model;

namespace {

/// Anchor of `joint` in the frame of `body`, one of its two bodies.
const Vec3& anchor_in(const Joint& joint, int body) {
  return joint.body_a == body ? joint.anchor_a : joint.anchor_b;
}

/// Anchor of `joint` as the body other than `body` has it [m, world frame].
Vec3 anchor_of_neighbour(const Joint& joint, int body, PoseView poses) {
  const int other = joint.body_a == body ? joint.body_b : joint.body_a;
  const auto i = static_cast<std::size_t>(other);
  return Pose{poses.position[i], poses.orientation[i]}.point_to_outer(anchor_in(joint, other));
}

bool joins_segments(const Joint& joint, int body) {
  return model::traits_of(joint.kind).has_anchor() && joint.body_b != model::no_body &&
         (joint.body_a == body || joint.body_b == body);
}

}  // namespace

std::vector<Segment> human_segments(const Model& model) {
  constexpr double least_length_m = 0.01;  // two joints at one point have no segment between them
  std::vector<Segment> segments;
  for (int body = 0; body < model.num_bodies(); ++body) {
    const auto actor = static_cast<std::size_t>(model.bodies[static_cast<std::size_t>(body)].actor);
    if (model.actors[actor].kind != model::ActorKind::human) continue;
    std::vector<int> joints;
    for (std::size_t j = 0; j < model.joints.size(); ++j) {
      if (joins_segments(model.joints[j], body)) joints.push_back(static_cast<int>(j));
    }
    for (std::size_t a = 0; a < joints.size(); ++a) {
      for (std::size_t b = a + 1; b < joints.size(); ++b) {
        const Joint& first = model.joints[static_cast<std::size_t>(joints[a])];
        const Joint& second = model.joints[static_cast<std::size_t>(joints[b])];
        const double length = (anchor_in(first, body) - anchor_in(second, body)).norm();
        if (length >= least_length_m) segments.push_back({body, joints[a], joints[b], length});
      }
    }
  }
  return segments;
}

std::vector<double> segment_stretch(const Model& model, const std::vector<Segment>& segments,
                                    PoseView poses) {
  std::vector<double> stretch;
  stretch.reserve(segments.size());
  for (const Segment& segment : segments) {
    if (!poses.holds(static_cast<std::size_t>(segment.joint_a)) ||
        !poses.holds(static_cast<std::size_t>(segment.joint_b)))
      continue;
    const Joint& a = model.joints[static_cast<std::size_t>(segment.joint_a)];
    const Joint& b = model.joints[static_cast<std::size_t>(segment.joint_b)];
    const Vec3 across =
        anchor_of_neighbour(a, segment.body, poses) - anchor_of_neighbour(b, segment.body, poses);
    stretch.push_back(across.allFinite() ? std::abs(across.norm() / segment.length_m - 1)
                                         : std::numeric_limits<double>::quiet_NaN());
  }
  return stretch;
}

}  // namespace pbmpi::analysis
