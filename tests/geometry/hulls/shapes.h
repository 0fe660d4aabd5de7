/// Hulls for tests.
#pragma once

#include <vector>

#include "../random_points.h"
#include "geometry/geometry.h"
#include "geometry/hulls/convex_hull.h"

namespace pbmpi::geometry {

inline std::vector<core::Vec3> corners_of_box(const core::Vec3& sides) {
  std::vector<core::Vec3> corners;
  for (int i = 0; i < 8; ++i) {
    const core::Vec3 signs((i & 1) != 0 ? 1 : -1, (i & 2) != 0 ? 1 : -1, (i & 4) != 0 ? 1 : -1);
    corners.push_back(0.5 * sides.cwiseProduct(signs));
  }
  return corners;
}

/// `count` points on a ball, which depend on `variant`.
inline std::vector<core::Vec3> points_on_ball(int count, int variant, double radius) {
  std::vector<core::Vec3> points;
  for (int i = 0; static_cast<int>(points.size()) < count; ++i) {
    const core::Vec3 one = point(i, static_cast<std::uint64_t>(10 * variant), 2) - core::Vec3::Ones();
    if (one.norm() > 0.1 && one.norm() < 1) points.push_back(radius * one.normalized());
  }
  return points;
}

inline model::Geom geom_of(const std::vector<core::Vec3>& points) {
  const FoundHull found = convex_hull(points, most_hull_vertices, "test");
  model::Geom geom;
  geom.shape = model::Shape::hull;
  geom.size = size_of(*found.hull);
  geom.hull = found.hull;
  return geom;
}

inline model::Geom geom_of(model::Shape shape, const std::array<double, 3>& size) {
  model::Geom geom;
  geom.shape = shape;
  geom.size = size;
  return geom;
}

/// A pose whose turn depends on `i`.
inline model::BodyPose pose_at(const core::Vec3& place, int i) {
  const auto part = [&](std::uint64_t k) { return 2 * number(i, 900 + k) - 1; };
  const Eigen::Quaterniond turn = Eigen::Quaterniond(part(0), part(1), part(2), part(3)).normalized();
  return body_pose({place, core::Quat::from_eigen(turn)});
}

}  // namespace pbmpi::geometry
