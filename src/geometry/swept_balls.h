/// Finds, of many balls that move, those that a way may meet.
#pragma once

#include <vector>

#include "geometry/box.h"

namespace pbmpi::geometry {

/// A ball about a point and all that it sweeps on its own way, as boxes; up to sixteen of a family that
/// follow each other have one box about them all, so that a way passes most of them at one test.
class SweptBalls {
 public:
  void clear();
  /// The next ball [m, world frame], and the way that it goes in the step. A centre that is not finite is met
  /// by nothing.
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
    std::size_t begin = 0, end = 0;  ///< of its boxes
    Box box;
  };
  static constexpr std::size_t group_size = 16;
  std::vector<Box> boxes_;
  std::vector<Group> groups_;
};

/// The box about a ball and its way. Larger than need be by 1e-6 of its coordinates, so that no rounding of
/// what is then computed within it matters.
Box swept_box(const core::Vec3& centre, double radius, const core::Vec3& way);

}  // namespace pbmpi::geometry
