#include "scenes/meshes/hulls.h"

#include <algorithm>

#include "core/text.h"

namespace pbmpi::scenes {

Solid solid_of(const geometry::FoundHull& found, const core::Pose& frame) {
  return {model::Shape::hull,
          geometry::size_of(*found.hull),
          {frame.point_to_outer(found.centre), frame.orientation},
          found.hull};
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
