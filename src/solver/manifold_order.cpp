#include "solver/manifold_order.h"

#include <algorithm>

namespace pbmpi::solver {

namespace {

std::size_t bucket_of(int color, int num_points) {
  return static_cast<std::size_t>(color * ManifoldOrder::most_points + ManifoldOrder::most_points -
                                  num_points);
}

}  // namespace

void ManifoldOrder::clear() {
  painted_.clear();
  next_.clear();
}

void ManifoldOrder::start_world(int num_bodies) {
  num_bodies_ = num_bodies;
  started_ = false;
}

void ManifoldOrder::add(std::span<const model::Contact> points, LanePlace a, LanePlace b) {
  if (!started_) painter_.start(num_bodies_);
  started_ = true;
  const int color = painter_.paint(points.front().body_a, points.front().body_b);
  const int num_points = static_cast<int>(points.size());
  const std::size_t num_buckets = bucket_of(color + 1, most_points);
  if (num_buckets > next_.size()) next_.resize(num_buckets, 0);
  ++next_[bucket_of(color, num_points)];
  painted_.push_back({{points.data(), num_points, a, b}, color});
}

void ManifoldOrder::sort_by_color() {
  int end = 0;
  for (int& count : next_) {  // from here on: where the bucket's next manifold goes
    const int begin = end;
    end += count;
    count = begin;
  }
  sorted_.resize(painted_.size());
  for (const Painted& painted : painted_) {
    int& next = next_[bucket_of(painted.color, painted.manifold.num_points)];
    sorted_[static_cast<std::size_t>(next++)] = painted.manifold;
  }
}

/// The first slot with room after those that the bodies have had.
int ManifoldOrder::choose_slot(const Manifold& manifold) const {
  int slot = std::max(ready_[index_of(manifold.a)], first_open_);
  if (moves(manifold.b)) slot = std::max(slot, ready_[index_of(manifold.b)]);
  while (slot < static_cast<int>(slots_.size()) &&
         slots_[static_cast<std::size_t>(slot)].used == num_lanes_) {
    ++slot;
  }
  return slot;
}

void ManifoldOrder::put(const Manifold& manifold, int slot) {
  if (slot == static_cast<int>(slots_.size())) {
    slots_.push_back({});
    for (int lane = 0; lane < num_lanes_; ++lane)
      dealt_.push_back({nullptr, 0, {static_slot_, lane}, {static_slot_, lane}});
  }
  Slot& chosen = slots_[static_cast<std::size_t>(slot)];
  dealt_[static_cast<std::size_t>(slot * num_lanes_ + chosen.used++)] = manifold;
  chosen.num_points = std::max(chosen.num_points, manifold.num_points);
  while (first_open_ < static_cast<int>(slots_.size()) &&
         slots_[static_cast<std::size_t>(first_open_)].used == num_lanes_) {
    ++first_open_;
  }
  ready_[index_of(manifold.a)] = slot + 1;
  if (moves(manifold.b)) ready_[index_of(manifold.b)] = slot + 1;
}

std::span<const Manifold> ManifoldOrder::deal(int num_lanes, int static_slot) {
  num_lanes_ = num_lanes;
  static_slot_ = static_slot;
  sort_by_color();
  slots_.clear();
  first_open_ = 0;
  dealt_.clear();
  ready_.assign(static_cast<std::size_t>(static_slot * num_lanes), 0);
  for (const Manifold& manifold : sorted_) put(manifold, choose_slot(manifold));
  return dealt_;
}

}  // namespace pbmpi::solver
