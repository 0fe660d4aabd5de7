#include "effects/approach.h"

#include <algorithm>
#include <cstddef>

#include "geometry/box.h"
#include "geometry/geometry.h"
#include "geometry/triangle_mesh.h"

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

double approach_to_mesh(const model::Geom& geom, const model::BodyPose& pose, const core::Vec3& way,
                        const geometry::TriangleMesh& mesh, const model::BodyPose& mesh_pose) {
  using RowMajor = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
  const core::Mat3 to_mesh = Eigen::Map<const RowMajor>(mesh_pose.rotation).transpose();
  const core::Vec3 centre = to_mesh * (core::Vec3(pose.position) - core::Vec3(mesh_pose.position));
  const core::Vec3 way_in_mesh = to_mesh * way;
  double most = 0;
  mesh.tree.for_each_near(geometry::swept_box(centre, geometry::bounding_radius(geom), way_in_mesh),
                          [&](int triangle) {
                            const auto& face = mesh.surface.faces[static_cast<std::size_t>(triangle)];
                            most = std::max(most, -face.normal.dot(way_in_mesh));
                          });
  return most;
}

}  // namespace

double approach_to_static(const model::Geom& geom, const model::BodyPose& pose, const core::Vec3& way,
                          const model::Geom& other, const model::BodyPose& other_pose) {
  if (other.shape == model::Shape::mesh) return approach_to_mesh(geom, pose, way, *other.mesh, other_pose);
  if (other.shape == model::Shape::plane) return std::max(0.0, -axis_of(other_pose, 2).dot(way));
  const core::Vec3 apart = from_core(other, other_pose, core::Vec3(pose.position));
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
