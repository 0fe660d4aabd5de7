/// Finds which of many boxes that do not move hold a point, or come near another box.
#pragma once

#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "core/random.h"
#include "geometry/box.h"

namespace pbmpi::geometry {

/// Boxes of any sizes in cubic cells. A box is in the cells that it overlaps, at most eight, of the level
/// whose cells are as large as the box; levels differ by factors of two. A query looks into the cells of all
/// levels, so that it takes a time that grows with the logarithm of the number of boxes.
class CellGrid {
 public:
  /// `group`: a query sees the boxes of its own group only.
  void add(int item, int group, const Box& box);
  /// After the last add().
  void finish();

  /// Calls found(item) for the boxes whose cells hold the point, until it returns true; boxes that do not
  /// hold it may be among them. Returns whether found() did.
  template <class Found>
  bool any_at(int group, const core::Vec3& point, const Found& found) const {
    for (const double place : point) {
      if (!(std::abs(place) < farthest_m)) return false;
    }
    for (const int level : levels_) {
      const double cell = std::ldexp(1.0, level);
      for (const Entry& entry :
           cell_at(group, level, index(point.x(), cell), index(point.y(), cell), index(point.z(), cell))) {
        if (found(entry.item)) return true;
      }
    }
    return false;
  }
  /// Calls found(item) for the boxes that share a cell with this one and are not of a lower level; some more
  /// than once, itself among them if it has been added.
  template <class Found>
  void for_each_near(int group, const Box& box, const Found& found) const {
    for (const int level : levels_) {
      if (level < level_of(box)) continue;
      for_each_cell(box, level, [&](std::int64_t x, std::int64_t y, std::int64_t z) {
        for (const Entry& entry : cell_at(group, level, x, y, z)) found(entry.item);
      });
    }
  }

 private:
  struct Entry {
    std::uint64_t cell = 0;  ///< its key; two cells with equal keys are searched as one
    int item = 0;
    auto operator<=>(const Entry&) const = default;
  };
  /// [m] No cells beyond.
  static constexpr double farthest_m = 1e12;

  static std::int64_t index(double place, double cell) {
    return static_cast<std::int64_t>(std::floor(place / cell));
  }
  static int level_of(const Box& box);
  template <class Visit>
  static void for_each_cell(const Box& box, int level, const Visit& visit) {
    const double cell = std::ldexp(1.0, level);
    for (std::int64_t x = index(box.min[0], cell); x <= index(box.max[0], cell); ++x) {
      for (std::int64_t y = index(box.min[1], cell); y <= index(box.max[1], cell); ++y) {
        for (std::int64_t z = index(box.min[2], cell); z <= index(box.max[2], cell); ++z) visit(x, y, z);
      }
    }
  }
  static std::uint64_t key(int group, int level, std::int64_t x, std::int64_t y, std::int64_t z) {
    const auto number = [](auto value) { return static_cast<std::uint64_t>(value); };
    return core::mix_key(core::mix_key(number(group), number(level), number(x)), number(y), number(z));
  }
  std::span<const Entry> cell_at(int group, int level, std::int64_t x, std::int64_t y, std::int64_t z) const;

  std::vector<int> levels_;     ///< ascending, each once
  std::vector<Entry> entries_;  ///< sorted
};

}  // namespace pbmpi::geometry
