/// Makes the convex polyhedron about points.
#pragma once

#include <memory>
#include <span>
#include <string>

#include "model/model.h"

namespace pbmpi::geometry {

inline constexpr int least_hull_vertices = 4, most_hull_vertices = 256;
/// What a hull may have unless a scene says otherwise.
inline constexpr int usual_hull_vertices = 64;

struct FoundHull {
  std::shared_ptr<const model::Hull> hull;
  core::Vec3 centre = core::Vec3::Zero();  ///< of mass [m], in the frame of the points
  double left_out_m = 0;                   ///< how far points stick out of it at most
};

/// The convex hull of `points` [m], or as much of it as `most_vertices` can span. Faces that lie in one plane
/// to within 2e-6 of the hull's extent become one. `where`: "file:line:column: what", for the
/// core::InputError that is thrown for fewer than four points, points that are not finite, or all in one
/// plane.
FoundHull convex_hull(std::span<const core::Vec3> points, int most_vertices, const std::string& where);

/// The geom's `size` for a hull.
std::array<double, 3> size_of(const model::Hull& hull);

}  // namespace pbmpi::geometry
