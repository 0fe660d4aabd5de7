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

void ManifoldOrder::add(const Manifold& manifold) {
  const std::size_t num_buckets = bucket_of(manifold.color + 1, most_points);
  if (num_buckets > next_.size()) next_.resize(num_buckets, 0);
  ++next_[bucket_of(manifold.color, manifold.num_points)];
  painted_.push_back(manifold);
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

/// Puts it into the last slot, or into a new one if the last is full or of another colour.
void ManifoldOrder::put(const Manifold& manifold) {
  const auto color = static_cast<std::size_t>(manifold.color);
  const bool is_new_color = color >= first_slot_.size();
  if (is_new_color || used_ == num_lanes_) {
    fill_last_slot();
    first_slot_.resize(color + 1, num_slots());
    num_points_.push_back(manifold.num_points);
    used_ = 0;
    const std::size_t needed = num_points_.size() * static_cast<std::size_t>(num_lanes_);
    if (needed > dealt_.size()) dealt_.resize(2 * needed);
  }
  dealt_[static_cast<std::size_t>((num_slots() - 1) * num_lanes_ + used_++)] = manifold;
}

/// Fills the lanes that have no manifold with idle ones.
void ManifoldOrder::fill_last_slot() {
  for (int lane = used_; num_slots() > 0 && lane < num_lanes_; ++lane)
    dealt_[static_cast<std::size_t>((num_slots() - 1) * num_lanes_ + lane)] = {
        nullptr, nullptr, 0, 0, {static_slot_, lane}, {static_slot_, lane}};
}

std::span<const Manifold> ManifoldOrder::deal(int num_lanes, int static_slot) {
  num_lanes_ = num_lanes;
  static_slot_ = static_slot;
  num_points_.clear();
  first_slot_.clear();
  used_ = 0;
  sort_by_color();
  for (const int i : by_color_) put(painted_[static_cast<std::size_t>(i)]);
  fill_last_slot();
  if (!first_slot_.empty()) first_slot_.push_back(num_slots());
  return dealt();
}

}  // namespace pbmpi::solver
