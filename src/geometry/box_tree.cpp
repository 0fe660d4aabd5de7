#include "geometry/box_tree.h"

#include <algorithm>
#include <cmath>

namespace pbmpi::geometry {

struct BoxTree::Centre {
  std::array<float, 3> at;
  int item;
};

void BoxTree::set(std::span<const Box> boxes) {
  constexpr std::size_t cost_to_arrange = 32;  // in visits to all items
  num_changed_ += boxes.size() / cost_to_arrange + 1;
  const bool order_matters = boxes.size() > fan_out;
  if (boxes.size() != order_.size() || (order_matters && num_changed_ > boxes.size())) arrange(boxes);
  for (std::size_t i = 0; i < order_.size(); ++i) levels_[0][i] = boxes[static_cast<std::size_t>(order_[i])];
  for (std::size_t level = 1; level < levels_.size(); ++level) {
    for (std::size_t node = 0; node < levels_[level].size(); ++node) refit(level, node);
  }
}

void BoxTree::change(std::span<const int> items, std::span<const Box> boxes) {
  constexpr std::size_t cost_of_one = 8;  // in visits to an item, when all are visited
  num_changed_ += items.size();
  if (boxes.size() != order_.size() || num_changed_ > order_.size() ||
      items.size() * cost_of_one > order_.size()) {
    set(boxes);
    return;
  }
  for (const int item : items) {
    std::size_t node = place_[static_cast<std::size_t>(item)];
    levels_[0][node] = boxes[static_cast<std::size_t>(item)];
    for (std::size_t level = 1; level < levels_.size(); ++level) refit(level, node /= fan_out);
  }
}

void BoxTree::refit(std::size_t level, std::size_t node) {
  const std::vector<Box>& below = levels_[level - 1];
  Box& box = levels_[level][node];
  box = {};
  const std::size_t first = node * fan_out, last = std::min(first + fan_out, below.size());
  for (std::size_t i = first; i < last; ++i) box.include(below[i]);
}

void BoxTree::arrange(std::span<const Box> boxes) {
  num_changed_ = 0;
  std::vector<Centre> centres(boxes.size());
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    centres[i].item = static_cast<int>(i);
    for (std::size_t k = 0; k < 3; ++k) {
      const auto middle = static_cast<float>(0.5 * (boxes[i].min[k] + boxes[i].max[k]));
      centres[i].at[k] = std::isfinite(middle) ? middle : 0;
    }
  }
  std::size_t block = fan_out;
  while (block * fan_out < centres.size()) block *= fan_out;
  arrange(centres, block);
  order_.resize(boxes.size());
  place_.resize(boxes.size());
  for (std::size_t i = 0; i < order_.size(); ++i) {
    order_[i] = centres[i].item;
    place_[static_cast<std::size_t>(order_[i])] = i;
  }
  levels_.clear();
  for (std::size_t size = boxes.size(); size > 0;) {
    levels_.emplace_back(size);
    if (size <= fan_out) break;
    size = (size + fan_out - 1) / fan_out;
  }
}

/// Divides the items across their longest side into two halves of whole blocks, and each half again, down to
/// single blocks, which are the items below one node; these are divided into the blocks of the level below.
void BoxTree::arrange(std::span<Centre> centres, std::size_t block) {
  if (centres.size() <= fan_out) return;
  while (centres.size() <= block) block /= fan_out;
  std::array<float, 3> low = centres[0].at, high = low;
  for (const Centre& centre : centres) {
    for (std::size_t k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], centre.at[k]);
      high[k] = std::max(high[k], centre.at[k]);
    }
  }
  std::size_t axis = 0;
  for (std::size_t k = 1; k < 3; ++k) {
    if (high[k] - low[k] > high[axis] - low[axis]) axis = k;
  }
  const std::size_t num_blocks = (centres.size() + block - 1) / block, half = num_blocks / 2 * block;
  std::nth_element(centres.begin(), centres.begin() + static_cast<std::ptrdiff_t>(half), centres.end(),
                   [axis](const Centre& a, const Centre& b) { return a.at[axis] < b.at[axis]; });
  arrange(centres.first(half), block);
  arrange(centres.subspan(half), block);
}

}  // namespace pbmpi::geometry
