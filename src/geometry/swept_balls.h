/// Finds which of many moving balls a path may meet.
#pragma once

#include <vector>

#include "geometry/box.h"
#include "geometry/box_tree.h"

namespace pbmpi::geometry {

/// Balls and the volumes that they sweep along their paths, as boxes; up to sixteen successive balls of a
/// family share one box around them all, so that one test rules most of them out, and these boxes are in a
/// tree.
class SweptBalls {
 public:
  void clear();
  /// Adds a ball [m, world frame] with its displacement in the step. Nothing meets a ball whose centre is not
  /// finite.
  void add(const core::Vec3& centre, double radius, const core::Vec3& way, int family);
  /// After the last add().
  void finish();

  /// Calls `found` with the index, in the order of add(), of each ball of other families that `box` may
  /// reach.
  template <class Found>
  void for_each_near(const Box& box, int but_family, Found&& found) const {
    tree_.for_each_near(box, [&](int index) {
      const Group& group = groups_[static_cast<std::size_t>(index)];
      if (group.family == but_family) return;
      for (std::size_t i = group.begin; i < group.end; ++i) {
        if (boxes_[i].overlaps(box)) found(static_cast<int>(i));
      }
    });
  }

 private:
  struct Group {
    int family = 0;
    std::size_t begin = 0, end = 0;  ///< range of its boxes in boxes_
    Box box;
  };
  static constexpr std::size_t group_size = 16;
  std::vector<Box> boxes_;
  std::vector<Group> groups_;
  std::vector<Box> group_boxes_;
  BoxTree tree_;  ///< of group_boxes_
};

}  // namespace pbmpi::geometry
