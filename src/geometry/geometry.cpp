#include "geometry/geometry.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "core/error.h"
#include "model/shape_traits.h"

namespace pbmpi::geometry {
namespace {

/// Half the extent [m] of a geom's box along a unit direction of the geom's frame. Sides of 0 are left out.
double reach_of_box(const Extent& extent, const double direction[3]) {
  double reach = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    if (extent.half[k] > 0) reach += std::abs(direction[k]) * extent.half[k];
  }
  return reach;
}

/// Extent [m] of a hull along a unit direction of its own frame.
double reach_of_hull(const model::Hull& hull, const core::Vec3& direction) {
  double reach = 0;
  for (const core::Vec3& vertex : hull.vertices) reach = std::max(reach, direction.dot(vertex));
  return reach;
}

}  // namespace

bool is_ball(const model::Geom& geom) {
  return geom.shape == model::Shape::sphere && geom.local.position.isZero(0);
}

void to_rotation(double w, double x, double y, double z, double rotation[9]) {
  const double xx = 2 * x * x, yy = 2 * y * y, zz = 2 * z * z;
  rotation[0] = 1 - yy - zz;
  rotation[1] = 2 * (x * y - w * z);
  rotation[2] = 2 * (x * z + w * y);
  rotation[3] = 2 * (x * y + w * z);
  rotation[4] = 1 - xx - zz;
  rotation[5] = 2 * (y * z - w * x);
  rotation[6] = 2 * (x * z - w * y);
  rotation[7] = 2 * (y * z + w * x);
  rotation[8] = 1 - xx - yy;
}

model::BodyPose body_pose(const core::Pose& pose) {
  const core::Quat& q = pose.orientation;
  model::BodyPose at;
  std::memcpy(at.position, pose.position.data(), sizeof at.position);
  to_rotation(q.w, q.x, q.y, q.z, at.rotation);
  return at;
}

model::BodyPose static_pose() { return {{0, 0, 0}, {1, 0, 0, 0, 1, 0, 0, 0, 1}}; }

model::BodyPose geom_pose(const model::Geom& geom, const model::BodyPose& body) {
  const core::Quat& q = geom.local.orientation;
  double local[9];
  to_rotation(q.w, q.x, q.y, q.z, local);
  model::BodyPose pose;
  for (int row = 0; row < 3; ++row) {
    const double* r = body.rotation + 3 * row;
    pose.position[row] = body.position[row] + r[0] * geom.local.position.x() +
                         r[1] * geom.local.position.y() + r[2] * geom.local.position.z();
    for (int col = 0; col < 3; ++col) {
      pose.rotation[3 * row + col] = r[0] * local[col] + r[1] * local[3 + col] + r[2] * local[6 + col];
    }
  }
  return pose;
}

Extent extent_of(const model::Geom& geom) {
  const model::ShapeTraits& traits = model::traits_of(geom.shape);
  const auto size = [&](int index) {
    return index == model::no_size ? 0 : geom.size[static_cast<std::size_t>(index)];
  };
  const double radius = size(traits.radius);
  return {{size(traits.length[0]) / 2, size(traits.length[1]) / 2, size(traits.length[2]) / 2},
          traits.is_round ? radius : 0,
          traits.is_round ? 0 : radius};
}

std::array<double, 3> half_extents(const model::Geom& geom, const double r[9]) {
  core::require_invariant(geom.shape != model::Shape::plane, "half_extents() of a plane, which has no end");
  const Extent extent = extent_of(geom);
  std::array<double, 3> half{};
  for (std::size_t k = 0; k < 3; ++k) {
    const double* row = r + 3 * k;
    half[k] = reach_of_box(extent, row) + extent.ball;
    if (extent.disc > 0) half[k] += extent.disc * std::sqrt(std::max(0.0, 1 - row[2] * row[2]));
  }
  return half;
}

double half_extent(const model::Geom& geom, const double rotation[9], const core::Vec3& direction) {
  if (geom.shape == model::Shape::plane) return model::infinity;
  double along[3];  // the direction in the geom's frame
  for (int k = 0; k < 3; ++k) {
    along[k] =
        rotation[k] * direction.x() + rotation[3 + k] * direction.y() + rotation[6 + k] * direction.z();
  }
  if (geom.shape == model::Shape::hull) return reach_of_hull(*geom.hull, {along[0], along[1], along[2]});
  const Extent extent = extent_of(geom);
  const double rim = extent.disc > 0 ? extent.disc * std::sqrt(along[0] * along[0] + along[1] * along[1]) : 0;
  return reach_of_box(extent, along) + extent.ball + rim;
}

double least_half_extent(const model::Geom& geom) {
  if (geom.shape == model::Shape::plane) return model::infinity;
  if (geom.shape == model::Shape::mesh) return 0;
  if (geom.shape == model::Shape::hull) {
    const auto lowest = std::ranges::min_element(geom.hull->faces, {}, &model::Hull::Face::height);
    return lowest->height;
  }
  const auto& [half, ball, disc] = extent_of(geom);
  if (ball > 0) return ball;
  return disc > 0 ? std::min(disc, half[2]) : std::min({half[0], half[1], half[2]});
}

double bounding_radius(const model::Geom& geom) {
  if (geom.shape == model::Shape::plane) return model::infinity;
  if (geom.shape == model::Shape::hull) {
    double most = 0;
    for (const core::Vec3& vertex : geom.hull->vertices) most = std::max(most, vertex.norm());
    return most;
  }
  const auto& [half, ball, disc] = extent_of(geom);
  return std::sqrt(half[0] * half[0] + half[1] * half[1] + half[2] * half[2] + disc * disc) + ball;
}

}  // namespace pbmpi::geometry
