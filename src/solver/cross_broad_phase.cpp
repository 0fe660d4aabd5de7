#include "solver/cross_broad_phase.h"

#include <algorithm>

namespace pbmpi::solver {
namespace {

using model::Box;

/// The axis along which the common part of two boxes is longest.
int longest_common_axis(const Box& a, const Box& b) {
  int longest = 0;
  double most = -1;
  for (int axis = 0; axis < 3; ++axis) {
    const auto k = static_cast<std::size_t>(axis);
    const double length = std::min(a.max[k], b.max[k]) - std::max(a.min[k], b.min[k]);
    if (length > most) longest = axis;
    most = std::max(most, length);
  }
  return longest;
}

}  // namespace

CrossBroadPhase::CrossBroadPhase(const model::Model& model, const model::SpaceMap& map)
    : model_(&model), rule_(model), map_(&map), geom_boxes_(model.geoms.size()) {}

void CrossBroadPhase::update_boxes(int space, std::span<const model::BodyPose> poses) {
  if (has_boxes_[space] != 0) return;
  has_boxes_[space] = 1;
  for (const int index : map_->geoms_of_space[space])
    geom_boxes_[index] = model::geom_box(model_->geoms[index], poses[model_->geoms[index].body]);
}

std::size_t CrossBroadPhase::enter(int space, const Box& box, int axis, bool in_second) {
  const std::size_t before = entries_.size();
  for (const int index : map_->geoms_of_space[space]) {
    if (geom_boxes_[index].overlaps(box))
      entries_.push_back({geom_boxes_[index].min[static_cast<std::size_t>(axis)], index, in_second});
  }
  return entries_.size() - before;
}

void CrossBroadPhase::sweep(int axis, std::vector<model::GeomPair>& pairs) {
  std::sort(entries_.begin(), entries_.end(), [](const Entry& a, const Entry& b) { return a.low < b.low; });
  for (auto a = entries_.begin(); a != entries_.end(); ++a) {
    const Box& box = geom_boxes_[a->geom];
    for (auto b = a + 1; b != entries_.end() && b->low <= box.max[static_cast<std::size_t>(axis)]; ++b) {
      if (a->in_second == b->in_second || !box.overlaps(geom_boxes_[b->geom])) continue;
      if (rule_.may_touch(a->geom, b->geom))
        pairs.push_back({std::min(a->geom, b->geom), std::max(a->geom, b->geom)});
    }
  }
}

void CrossBroadPhase::find_pairs(std::span<const int> owner, std::span<const Box> boxes,
                                 std::span<const model::BodyPose> poses,
                                 std::vector<model::GeomPair>& pairs) {
  pairs.clear();
  has_boxes_.assign(boxes.size(), 0);
  for (int a = 0; a < static_cast<int>(boxes.size()); ++a) {
    for (int b = a + 1; b < static_cast<int>(boxes.size()); ++b) {
      if (owner[a] == owner[b] || !boxes[a].overlaps(boxes[b])) continue;
      update_boxes(a, poses);
      update_boxes(b, poses);
      const int axis = longest_common_axis(boxes[a], boxes[b]);
      entries_.clear();
      if (enter(a, boxes[b], axis, false) > 0 && enter(b, boxes[a], axis, true) > 0) sweep(axis, pairs);
    }
  }
  std::sort(pairs.begin(), pairs.end());
}

}  // namespace pbmpi::solver
