/// The initial poses of a model's bodies.
#pragma once

#include <vector>

#include "geometry/geometry.h"

namespace pbmpi::support {

inline std::vector<model::BodyPose> body_poses(const model::Model& model) {
  std::vector<model::BodyPose> poses;
  for (const model::Body& body : model.bodies) poses.push_back(geometry::body_pose(body.pose));
  return poses;
}

}  // namespace pbmpi::support
