#include "effects/approach.h"

#include <algorithm>
#include <cstddef>

#include "geometry/box.h"
#include "geometry/geometry.h"

namespace pbmpi::effects {
namespace {

core::Vec3 axis_of(const model::BodyPose& pose, std::size_t k) {
  return {pose.rotation[k], pose.rotation[3 + k], pose.rotation[6 + k]};
}

/// From the nearest point of the geom's inner box to `point`; zero within it.
core::Vec3 from_core(const model::Geom& geom, const model::BodyPose& pose, const core::Vec3& point) {
  geometry::Extent extent = geometry::extent_of(geom);
  extent.half[0] += extent.disc;
  extent.half[1] += extent.disc;
  const core::Vec3 from_centre = point - core::Vec3(pose.position);
  core::Vec3 outside = core::Vec3::Zero();
  for (std::size_t k = 0; k < 3; ++k) {
    const core::Vec3 axis = axis_of(pose, k);
    const double along = axis.dot(from_centre);
    outside += (along - std::clamp(along, -extent.half[k], extent.half[k])) * axis;
  }
  return outside;
}

}  // namespace

double approach_to_static(const core::Vec3& centre, const core::Vec3& way, const model::Geom& other,
                          const model::BodyPose& other_pose) {
  if (other.shape == model::Shape::plane) return std::max(0.0, -axis_of(other_pose, 2).dot(way));
  const core::Vec3 apart = from_core(other, other_pose, centre);
  const double distance = apart.norm();
  return distance > 0 ? std::max(0.0, -apart.dot(way) / distance) : way.norm();
}

bool may_meet(const model::Geom& geom, const model::BodyPose& pose, const core::Vec3& way,
              const model::Geom& other, const model::BodyPose& other_pose, double room) {
  if (other.shape == model::Shape::plane) {
    const core::Vec3 normal = axis_of(other_pose, 2);
    const double height = normal.dot(core::Vec3(pose.position) - core::Vec3(other_pose.position));
    return height + normal.dot(way) <= geometry::half_extent(geom, pose.rotation, -normal) + room;
  }
  geometry::Box path = geometry::box_at(geom, pose);
  for (std::size_t k = 0; k < 3; ++k) {
    path.min[k] += std::min(0.0, way[static_cast<int>(k)]);
    path.max[k] += std::max(0.0, way[static_cast<int>(k)]);
  }
  return path.overlaps(geometry::box_at(other, other_pose).grown(room));
}

}  // namespace pbmpi::effects
