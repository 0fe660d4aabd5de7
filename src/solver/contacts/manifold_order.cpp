#include "solver/contacts/manifold_order.h"

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

void ManifoldOrder::add(std::span<const model::Contact> points, model::ContactForce* forces, LanePlace a,
                        LanePlace b) {
  if (!started_) painter_.start(num_bodies_);
  started_ = true;
  const int color = painter_.paint(points.front().body_a, points.front().body_b);
  const auto num_points = static_cast<short>(points.size());
  const std::size_t num_buckets = bucket_of(color + 1, most_points);
  if (num_buckets > next_.size()) next_.resize(num_buckets, 0);
  ++next_[bucket_of(color, num_points)];
  painted_.push_back({points.data(), forces, num_points, static_cast<short>(color), a, b});
}

/// Fills by_color_ with the indices of painted_.
void ManifoldOrder::sort_by_color() {
  int end = 0;
  for (int& count : next_) {  // from here on: where the bucket's next manifold goes
    const int begin = end;
    end += count;
    count = begin;
  }
  by_color_.resize(painted_.size());
  for (std::size_t i = 0; i < painted_.size(); ++i) {
    int& next = next_[bucket_of(painted_[i].color, painted_[i].num_points)];
    by_color_[static_cast<std::size_t>(next++)] = static_cast<int>(i);
  }
}

/// The first slot with room after those that the bodies have had.
int ManifoldOrder::choose_slot(const Manifold& manifold) const {
  int slot = std::max(ready_[index_of(manifold.a)], first_open_);
  if (moves(manifold.b)) slot = std::max(slot, ready_[index_of(manifold.b)]);
  while (slot < num_slots() && is_full(slot)) ++slot;
  return slot;
}

void ManifoldOrder::put(const Manifold& manifold, int slot) {
  if (slot == num_slots()) {
    slots_.push_back({});
    const std::size_t needed = slots_.size() * static_cast<std::size_t>(num_lanes_);
    if (needed > dealt_.size()) dealt_.resize(2 * needed);
  }
  Slot& chosen = slots_[static_cast<std::size_t>(slot)];
  dealt_[static_cast<std::size_t>(slot * num_lanes_ + chosen.used++)] = manifold;
  chosen.num_points = std::max<int>(chosen.num_points, manifold.num_points);
  while (first_open_ < num_slots() && is_full(first_open_)) ++first_open_;
  ready_[index_of(manifold.a)] = slot + 1;
  if (moves(manifold.b)) ready_[index_of(manifold.b)] = slot + 1;
}

/// Fills the lanes that have no manifold.
void ManifoldOrder::idle() {
  for (int slot = first_open_; slot < num_slots(); ++slot) {
    for (int lane = slots_[static_cast<std::size_t>(slot)].used; lane < num_lanes_; ++lane)
      dealt_[static_cast<std::size_t>(slot * num_lanes_ + lane)] = {
          nullptr, nullptr, 0, 0, {static_slot_, lane}, {static_slot_, lane}};
  }
}

std::span<const Manifold> ManifoldOrder::deal(int num_lanes, int static_slot) {
  num_lanes_ = num_lanes;
  static_slot_ = static_slot;
  slots_.clear();
  first_open_ = 0;
  if (painted_.empty()) return {};
  sort_by_color();
  ready_.assign(static_cast<std::size_t>(static_slot * num_lanes), 0);
  for (const int i : by_color_) {
    const Manifold& manifold = painted_[static_cast<std::size_t>(i)];
    put(manifold, choose_slot(manifold));
  }
  idle();
  return dealt();
}

}  // namespace pbmpi::solver
