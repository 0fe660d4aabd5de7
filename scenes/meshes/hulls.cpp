#include "scenes/meshes/hulls.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/elementary.h"
#include "core/text.h"

namespace pbmpi::scenes {

Solid solid_of(const geometry::FoundHull& found, const core::Pose& frame) {
  return {model::Shape::hull,
          geometry::size_of(*found.hull),
          {frame.point_to_outer(found.centre), frame.orientation},
          found.hull};
}

/// Spread evenly, on a spiral (R. Swinbank and R. J. Purser, "Fibonacci grids", Q. J. R. Meteorol. Soc. 132,
/// 2006).
geometry::FoundHull hull_of_ellipsoid(const core::Vec3& half, const std::string& where) {
  constexpr int count = 128;
  std::vector<core::Vec3> points;
  for (int i = 0; i < count; ++i) {
    const double z = (2 * i + 1.0) / count - 1, radius = std::sqrt(1 - z * z);
    const double turns = i / std::numbers::phi;
    const double angle = 2 * std::numbers::pi * (turns - std::floor(turns));
    points.push_back(
        half.cwiseProduct(core::Vec3(radius * core::cosine(angle), radius * core::sine(angle), z)));
  }
  return geometry::convex_hull(points, count, where);
}

std::string note_on(const geometry::FoundHull& found, double before_m) {
  const auto size = geometry::size_of(*found.hull);
  const double left_out = found.left_out_m + before_m;
  constexpr double rounding = 1e-5;  // of the size
  if (left_out <= rounding * *std::ranges::max_element(size)) return "";
  return "a hull of " + std::to_string(found.hull->vertices.size()) +
         " vertices, out of which others stick by up to " + core::number_text(left_out) + " m";
}

}  // namespace pbmpi::scenes
