/// Finds which of many boxes overlap another.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "geometry/box.h"

namespace pbmpi::geometry {

/// A tree of boxes: each node is the box around eight nodes of the level below. Boxes that move are changed
/// in place; the items are arranged anew, neighbours in space side by side, once so many have changed that
/// the work is paid for. A query looks at some ten times as many boxes as it finds, plus the depth of the
/// tree, whatever the sizes of the boxes. A box with a NaN overlaps none.
class BoxTree {
 public:
  /// Item i has boxes[i].
  void set(std::span<const Box> boxes);
  /// Gives other boxes to some items: items[i] has boxes[items[i]], where `boxes` is [num_items].
  void change(std::span<const int> items, std::span<const Box> boxes);

  /// Calls found(item) for each item whose box overlaps `box`.
  template <class Found>
  void for_each_near(const Box& box, const Found& found) const {
    any_near(box, [&](int item) {
      found(item);
      return false;
    });
  }
  /// Calls found(item) for items whose boxes overlap `box` until it returns true, and returns whether it did.
  template <class Found>
  bool any_near(const Box& box, const Found& found) const {
    if (levels_.empty()) return false;
    std::array<Node, most_levels * fan_out> open;  // the rest of one node at each level
    std::size_t num_open = 0;
    const auto add = [&](std::size_t level, std::size_t first) {
      const std::vector<Box>& boxes = levels_[level];
      for (std::size_t i = std::min(first + fan_out, boxes.size()); i-- > first;) {
        if (boxes[i].overlaps(box)) open[num_open++] = {level, i};
      }
    };
    add(levels_.size() - 1, 0);
    while (num_open > 0) {
      const Node node = open[--num_open];
      if (node.level > 0) {
        add(node.level - 1, node.index * fan_out);
      } else if (found(order_[node.index])) {
        return true;
      }
    }
    return false;
  }

 private:
  static constexpr std::size_t fan_out = 8;
  static constexpr std::size_t most_levels = 12;  ///< 8^11 items are more than an int counts

  struct Node {
    std::size_t level = 0, index = 0;
  };
  struct Centre;

  void arrange(std::span<const Box> boxes);
  static void arrange(std::span<Centre> centres, std::size_t block);
  void refit(std::size_t level, std::size_t node);

  std::vector<int> order_;                ///< the items as the leaves hold them
  std::vector<std::size_t> place_;        ///< [num_items] leaf of each item
  std::vector<std::vector<Box>> levels_;  ///< [0]: leaves; the last has fan_out nodes at most
  std::size_t num_changed_ = 0;           ///< since the items were arranged
};

}  // namespace pbmpi::geometry
