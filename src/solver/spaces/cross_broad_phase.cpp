#include "solver/spaces/cross_broad_phase.h"

#include <algorithm>
#include <array>

namespace pbmpi::solver {
namespace {

using geometry::Box;

/// Sums up the sides of boxes, and the box around them all.
class Extents {
 public:
  void add(const Box& box) {
    all_.include(box);
    for (std::size_t axis = 0; axis < 3; ++axis) sum_[axis] += box.max[axis] - box.min[axis];
  }
  /// The axis along which a box covers the least share of the whole, and hence meets the fewest others.
  std::size_t best_axis() const {
    std::size_t best = 0;
    for (std::size_t axis = 1; axis < 3; ++axis) {
      // sum / length, without dividing by a length of 0
      if (sum_[axis] * length(best) < sum_[best] * length(axis)) best = axis;
    }
    return best;
  }

 private:
  double length(std::size_t axis) const { return all_.max[axis] - all_.min[axis]; }
  Box all_;
  std::array<double, 3> sum_{};
};

}  // namespace

CrossBroadPhase::CrossBroadPhase(const model::Model& model, const SpaceBodies& bodies)
    : model_(&model), rule_(model), bodies_(&bodies) {}

bool CrossBroadPhase::find_neighbours(std::span<const int> owner, std::span<const Box> boxes) {
  neighbours_.resize(boxes.size());
  for (std::vector<int>& spaces : neighbours_) spaces.clear();
  space_tree_.set(boxes);
  for (std::size_t space = 0; space < boxes.size(); ++space) {
    space_tree_.for_each_near(boxes[space], [&](int other) {
      if (owner[space] != owner[other]) neighbours_[space].push_back(other);
    });
  }
  return std::ranges::any_of(neighbours_, [](const std::vector<int>& spaces) { return !spaces.empty(); });
}

std::vector<int> CrossBroadPhase::near_spaces(std::span<const int> owner, std::span<const Box> boxes) {
  find_neighbours(owner, boxes);
  return near_spaces();
}

std::vector<int> CrossBroadPhase::near_spaces() const {
  std::vector<int> spaces;
  for (std::size_t space = 0; space < neighbours_.size(); ++space) {
    if (!neighbours_[space].empty()) spaces.push_back(static_cast<int>(space));
  }
  return spaces;
}

void CrossBroadPhase::enter(int space, int owner, std::span<const Box> boxes,
                            std::span<const model::BodyPose> poses) {
  const std::vector<int>& neighbours = neighbours_[space];
  if (neighbours.empty()) return;
  const auto reaches_in = [&](const Box& box) {
    return std::any_of(neighbours.begin(), neighbours.end(),
                       [&](int other) { return box.overlaps(boxes[other]); });
  };
  for (const int body : bodies_->bodies(space)) {
    if (!reaches_in(bodies_->ball_box(body, poses[body]))) continue;
    for (const int geom : bodies_->geoms(body)) {
      const Box box = geometry::geom_box(model_->geoms[geom], poses[body]).grown(bodies_->margin_m());
      if (reaches_in(box)) entries_.push_back({box, geom, owner});
    }
  }
}

void CrossBroadPhase::sort_along(std::size_t axis) {
  for (auto& order : order_) order.clear();
  for (std::size_t i = 0; i < entries_.size(); ++i) {
    const auto owner = static_cast<std::size_t>(entries_[i].owner);
    if (owner >= order_.size()) order_.resize(owner + 1);
    order_[owner].emplace_back(entries_[i].box.min[axis], static_cast<int>(i));
  }
  lists_.resize(order_.size());
  for (std::size_t owner = 0; owner < order_.size(); ++owner) {
    std::sort(order_[owner].begin(), order_[owner].end());
    lists_[owner].clear();
    for (const auto& [low, index] : order_[owner]) lists_[owner].push_back(entries_[index]);
  }
}

void CrossBroadPhase::sweep(std::span<const Entry> a, std::span<const Entry> b, std::size_t axis, bool ties,
                            std::vector<model::GeomPair>& pairs) const {
  auto first = a.begin();
  for (const Entry& other : b) {
    const double low = other.box.min[axis], high = other.box.max[axis];
    while (first != a.end() && (ties ? first->box.min[axis] < low : first->box.min[axis] <= low)) ++first;
    for (auto entry = first; entry != a.end() && entry->box.min[axis] <= high; ++entry) {
      if (!entry->box.overlaps(other.box) || !rule_.may_touch(entry->geom, other.geom)) continue;
      pairs.push_back({std::min(entry->geom, other.geom), std::max(entry->geom, other.geom)});
    }
  }
}

void CrossBroadPhase::find_pairs(std::span<const int> owner, std::span<const Box> boxes,
                                 std::span<const model::BodyPose> poses,
                                 std::vector<model::GeomPair>& pairs) {
  pairs.clear();
  if (!find_neighbours(owner, boxes)) return;
  entries_.clear();
  for (std::size_t space = 0; space < boxes.size(); ++space)
    enter(static_cast<int>(space), owner[space], boxes, poses);
  Extents extents;
  for (const Entry& entry : entries_) extents.add(entry.box);
  const std::size_t axis = extents.best_axis();
  sort_along(axis);
  for (std::size_t a = 0; a < lists_.size(); ++a) {
    for (std::size_t b = a + 1; b < lists_.size(); ++b) {
      sweep(lists_[a], lists_[b], axis, true, pairs);
      sweep(lists_[b], lists_[a], axis, false, pairs);
    }
  }
  std::sort(pairs.begin(), pairs.end());
}

}  // namespace pbmpi::solver
