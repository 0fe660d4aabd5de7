#include "geometry/hulls/convex_hull.h"

#include <algorithm>

#include "core/error.h"
#include "geometry/hulls/hull_faces.h"
#include "geometry/hulls/solid_integrals.h"
#include "geometry/hulls/triangle_hull.h"

namespace pbmpi::geometry {
namespace {

/// Shares of the points' largest extent: what sticks out by less is no vertex, and faces within so much of a
/// plane are one. Files with single precision place points to 1e-7 of it.
constexpr double tolerance_share = 1e-6, flat_share = 2e-6;

SolidIntegrals integrals_of(const model::Hull& hull) {
  SolidIntegrals sum;
  const auto corner = [&](int i) -> const core::Vec3& {
    return hull.vertices[static_cast<std::size_t>(hull.corners[static_cast<std::size_t>(i)])];
  };
  for (const model::Hull::Face& face : hull.faces) {
    for (int i = 1; i + 1 < face.count; ++i)
      sum.add(corner(face.first), corner(face.first + i), corner(face.first + i + 1));
  }
  return sum;
}

double highest(const model::Hull& hull, const core::Vec3& point) {
  double most = -model::infinity;
  for (const model::Hull::Face& face : hull.faces)
    most = std::max(most, face.normal.dot(point) - face.height);
  return most;
}

double largest_side(std::span<const core::Vec3> points) {
  core::Vec3 low = points[0], high = points[0];
  for (const core::Vec3& point : points) {
    low = low.cwiseMin(point);
    high = high.cwiseMax(point);
  }
  return (high - low).maxCoeff();
}

void move_to_centre(const core::Vec3& centre, model::Hull& hull) {
  for (core::Vec3& vertex : hull.vertices) vertex -= centre;
  for (model::Hull::Face& face : hull.faces) face.height -= face.normal.dot(centre);
}

}  // namespace

FoundHull convex_hull(std::span<const core::Vec3> points, int most_vertices, const std::string& where) {
  core::require_input(points.size() >= 4, where + ": a hull needs at least 4 points, and there are " +
                                              std::to_string(points.size()) + "; give more");
  const bool finite = std::ranges::all_of(points, [](const core::Vec3& point) { return point.allFinite(); });
  core::require_input(finite, where + ": a point is not finite; correct it");
  const double extent = largest_side(points);
  TriangleHull triangles(points, tolerance_share * extent);
  core::require_input(triangles.is_solid(),
                      where +
                          ": all points lie in one plane, which encloses no volume; give "
                          "one that does not");
  triangles.grow(most_vertices);
  model::Hull hull = hull_of(triangles, points, flat_share * extent);
  const SolidIntegrals first = integrals_of(hull);
  core::require_invariant(first.volume() > 0, "a hull with a volume");
  FoundHull found;
  found.centre = first.centre();
  for (const core::Vec3& point : points) found.left_out_m = std::max(found.left_out_m, highest(hull, point));
  move_to_centre(found.centre, hull);
  const SolidIntegrals about = integrals_of(hull);
  hull.volume = about.volume();
  hull.surface = about.surface();
  hull.inertia = about.inertia();
  found.hull = std::make_shared<const model::Hull>(std::move(hull));
  return found;
}

std::array<double, 3> size_of(const model::Hull& hull) {
  core::Vec3 half = core::Vec3::Zero();
  for (const core::Vec3& vertex : hull.vertices) half = half.cwiseMax(vertex.cwiseAbs());
  return {2 * half.x(), 2 * half.y(), 2 * half.z()};
}

}  // namespace pbmpi::geometry
