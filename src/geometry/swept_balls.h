/// Finds, of many balls that move, those that a way may meet.
#pragma once

#include <vector>

#include "geometry/box.h"

namespace pbmpi::geometry {

/// A ball about a point and all that it sweeps on its own way, as boxes; sixteen that follow each other have
/// one box about them all, so that a way passes most of them at one test.
class SweptBalls {
 public:
  void clear();
  /// The next ball [m, world frame], and the way that it goes in the step. A centre that is not finite is met
  /// by nothing.
  void add(const core::Vec3& centre, double radius, const core::Vec3& way);

  /// Calls `found` with the index of each ball that `box` may reach, in the order of add().
  template <class Found>
  void for_each_near(const Box& box, Found&& found) const {
    for (std::size_t group = 0; group < groups_.size(); ++group) {
      if (!groups_[group].overlaps(box)) continue;
      const std::size_t end = std::min(boxes_.size(), (group + 1) * group_size);
      for (std::size_t i = group * group_size; i < end; ++i) {
        if (boxes_[i].overlaps(box)) found(static_cast<int>(i));
      }
    }
  }

 private:
  static constexpr std::size_t group_size = 16;
  std::vector<Box> boxes_, groups_;
};

/// The box about a ball and its way. Larger than need be by 1e-6 of its coordinates, so that no rounding of
/// what is then computed within it matters.
Box swept_box(const core::Vec3& centre, double radius, const core::Vec3& way);

}  // namespace pbmpi::geometry
