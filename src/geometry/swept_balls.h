/// Finds which of many moving balls a path may meet.
#pragma once

#include <vector>

#include "geometry/box.h"

namespace pbmpi::geometry {

/// Balls and the volumes that they sweep along their paths, as boxes; up to sixteen successive balls of a
/// family share one box around them all, so that one test rules most of them out.
class SweptBalls {
 public:
  void clear();
  /// Adds a ball [m, world frame] with its displacement in the step. Nothing meets a ball whose centre is not
  /// finite.
  void add(const core::Vec3& centre, double radius, const core::Vec3& way, int family);

  /// Calls `found` with the index of each ball of other families that `box` may reach, in the order of add().
  template <class Found>
  void for_each_near(const Box& box, int but_family, Found&& found) const {
    for (const Group& group : groups_) {
      if (group.family == but_family || !group.box.overlaps(box)) continue;
      for (std::size_t i = group.begin; i < group.end; ++i) {
        if (boxes_[i].overlaps(box)) found(static_cast<int>(i));
      }
    }
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
};

/// The box around a ball swept along its path. It is larger than needed by 1e-6 of its coordinates, so that
/// rounding in later computations within it does not matter.
Box swept_box(const core::Vec3& centre, double radius, const core::Vec3& way);

}  // namespace pbmpi::geometry
