#include "geometry/swept_balls.h"

namespace pbmpi::geometry {

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

void SweptBalls::finish() {
  group_boxes_.clear();
  for (const Group& group : groups_) group_boxes_.push_back(group.box);
  tree_.set(group_boxes_);
}

}  // namespace pbmpi::geometry
