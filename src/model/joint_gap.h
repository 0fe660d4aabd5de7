/// How far a joint has been pulled apart.
#pragma once

#include <vector>

#include "model/model.h"
#include "model/state.h"

namespace pbmpi::model {

/// Vector from b's copy to a's copy of the point that a joint holds [m], world frame. `a`, `b`: the poses of
/// the joint's bodies; the world's pose is Pose{}. Ball, hinge, universal and hinge2 joints hold their
/// anchors, slider and fixed joints the offset that the bodies had at the start. Directions in which the
/// joint slides (the axis of a slider or a suspension) are left out.
Vec3 joint_gap_vector(const Model& model, const Joint& joint, const Pose& a, const Pose& b);

/// joint_gap_vector() in the frame of a, computed there: far from the world's origin it loses fewer digits.
Vec3 joint_gap_vector_in_a(const Model& model, const Joint& joint, const Pose& a, const Pose& b);

/// Length [m] of joint_gap_vector().
double joint_gap(const Model& model, const State& state, const Joint& joint);

/// What joint_gap_vector() needs to know of a joint.
struct HeldPoint {
  int body_a = 0, body_b = no_body;
  bool slides = false;  ///< do the bodies slide along the axis?
  Vec3 in_a, in_b;      ///< the point that the joint holds, in the frames of its bodies [m]
  Vec3 axis;            ///< unit, frame of a
};

/// Measures the gaps of one model's joints. The held points are stored contiguously: fetching them from among
/// the names and motors of a model would cost more than the gaps themselves.
class JointGaps {
 public:
  explicit JointGaps(const Model& model);
  /// The largest joint_gap() of the unbroken joints [m]; 0 without any.
  double largest(const State& state) const;

 private:
  std::vector<HeldPoint> held_;  ///< [num_joints]
};

/// JointGaps::largest() of a single state.
double max_joint_gap(const Model& model, const State& state);

}  // namespace pbmpi::model
