/// An invariant of a world, independent of any reference: the length of human segments.
#pragma once

#include <vector>

#include "analysis/pose_errors.h"
#include "model/state.h"

namespace pbmpi::analysis {

/// A part of a human between two joints: a body of an actor of kind human, and two joints between it and
/// other bodies.
struct Segment {
  int body = 0;
  int joint_a = 0, joint_b = 0;  ///< indices into Model::joints
  double length_m = 0;           ///< distance of the two anchors in the body, at least 1 cm
};

std::vector<Segment> human_segments(const model::Model& model);

/// |d / length - 1| of each segment, where d is the distance between the two anchors as the neighbouring
/// segments have them, so that joints pulled apart show as stretch. NaN if d is not finite. A segment with a
/// broken joint is left out.
std::vector<double> segment_stretch(const model::Model& model, const std::vector<Segment>& segments,
                                    PoseView poses);

}  // namespace pbmpi::analysis
