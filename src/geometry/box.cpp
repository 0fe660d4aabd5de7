#include "geometry/box.h"

#include <cmath>

#include "geometry/geometry.h"

namespace pbmpi::geometry {

Box geom_box(const model::Geom& geom, const model::BodyPose& body) {
  const core::Pose& local = geom.local;
  const bool centred = local.position.isZero(0) && local.orientation.w == 1;  // geom_pose() is then the same
  return box_at(geom, centred ? body : geom_pose(geom, body));
}

Box box_at(const model::Geom& geom, const model::BodyPose& pose) {
  const std::array<double, 3> half = half_extents(geom, pose.rotation);
  Box box;
  for (std::size_t k = 0; k < 3; ++k) {
    const double slack = 1e-6 * (std::abs(pose.position[k]) + half[k]);
    box.min[k] = pose.position[k] - half[k] - slack;
    box.max[k] = pose.position[k] + half[k] + slack;
  }
  return box;
}

Box swept_box(const core::Vec3& centre, double radius, const core::Vec3& way) {
  Box box;
  for (std::size_t k = 0; k < 3; ++k) {
    const double from = centre[static_cast<int>(k)], along = way[static_cast<int>(k)];
    const double margin = radius + 1e-6 * (std::abs(from) + std::abs(along) + radius);
    box.min[k] = from + std::min(0.0, along) - margin;
    box.max[k] = from + std::max(0.0, along) + margin;
  }
  return box;
}

}  // namespace pbmpi::geometry
