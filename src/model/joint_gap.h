/// How far a joint has been pulled apart.
#pragma once

#include "model/model.h"
#include "model/state.h"

namespace pbmpi::model {

/// From b's to a's copy of the point that a joint holds [m], world frame. `a`, `b`: the poses of the joint's
/// bodies; that of the world is Pose{}. Ball, hinge, universal and hinge2 joints hold their anchors, slider
/// and fixed joints the offset that the bodies had at the start. Directions in which the joint slides (a
/// slider's axis, that of a suspension) are left out.
Vec3 joint_gap_vector(const Model& model, const Joint& joint, const Pose& a, const Pose& b);

/// joint_gap_vector() in the frame of a, worked out there: far from the world's origin it loses fewer digits.
Vec3 joint_gap_vector_in_a(const Model& model, const Joint& joint, const Pose& a, const Pose& b);

/// Length [m] of joint_gap_vector().
double joint_gap(const Model& model, const State& state, const Joint& joint);

/// The largest joint_gap() of the world's joints that hold [m]; 0 without any.
double max_joint_gap(const Model& model, const State& state);

}  // namespace pbmpi::model
