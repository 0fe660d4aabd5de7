#include "geometry/swept_balls.h"

#include <cmath>

namespace pbmpi::geometry {

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

void SweptBalls::clear() {
  boxes_.clear();
  groups_.clear();
}

void SweptBalls::add(const core::Vec3& centre, double radius, const core::Vec3& way, int family) {
  const std::size_t i = boxes_.size();
  if (groups_.empty() || groups_.back().family != family || i - groups_.back().begin == group_size)
    groups_.push_back({.family = family, .begin = i, .end = i, .box = {}});
  boxes_.push_back(swept_box(centre, radius, way));
  groups_.back().box.include(boxes_.back());
  groups_.back().end = i + 1;
}

}  // namespace pbmpi::geometry
