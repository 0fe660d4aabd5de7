/// Boxes around groups of geoms, so that a sweep of many geoms tests only groups that are near.
#pragma once

#include <algorithm>
#include <cstdint>

#include "solver/collide/geom_lanes.h"

namespace pbmpi::solver {

/// One box in all lanes.
template <class T>
class BoxLanes {
 public:
  using V = typename T::V;
  using Column = GeomColumn<T>;

  PBMPI_LANES BoxLanes(const Column* min, const Column* max, int index) {
    for (int k = 0; k < 3; ++k) {
      low_[k] = T::broadcast(min[k].data()[index]);
      high_[k] = T::broadcast(max[k].data()[index]);
    }
  }
  /// Bit b: does it overlap box first + b of these columns?
  PBMPI_LANES unsigned overlapping(const Column* min, const Column* max, int first) const {
    const V zero = T::broadcast(0);
    V overlap = T::broadcast(1);
    for (int k = 0; k < 3; ++k) {
      overlap = min[k].from(first) <= high_[k] ? overlap : zero;
      overlap = low_[k] <= max[k].from(first) ? overlap : zero;
    }
    return T::bits(overlap);
  }

 private:
  V low_[3], high_[3];
};

/// The geoms of one world in groups of sixteen: neighbours in a model are mostly neighbours in space.
template <class T>
class GroupBoxes {
 public:
  using V = typename T::V;
  using Scalar = typename T::Scalar;

  static constexpr int group_size = 16;  ///< the same for, and a multiple of, every number of lanes
  static constexpr int most_groups = 64;

  GroupBoxes() {
    for (Column& column : min_) column.resize(most_groups / T::num_lanes);
    for (Column& column : max_) column.resize(most_groups / T::num_lanes);
  }

  /// Computes the groups' boxes from those of a world's geoms, which are consecutive. A box with a NaN counts
  /// as empty.
  void update(const GeomLanes<T>& geoms, int first_column, int num_geoms);

  /// Bit g: does `box` overlap that of group g, g >= first_group?
  std::uint64_t overlapping(const BoxLanes<T>& box, int first_group) const;

 private:
  using Column = GeomColumn<T>;

  Column min_[3], max_[3];
  int num_groups_ = 0;
};

template <class T>
void GroupBoxes<T>::update(const GeomLanes<T>& geoms, int first_column, int num_geoms) {
  num_groups_ = (num_geoms + group_size - 1) / group_size;
  for (int k = 0; k < 3; ++k) {
    const Scalar* low = geoms.box_min[k].data() + first_column;
    const Scalar* high = geoms.box_max[k].data() + first_column;
    for (int group = 0; group < num_groups_; ++group) {
      Scalar least = static_cast<Scalar>(huge_bound), greatest = -least;
      for (int i = group * group_size; i < std::min((group + 1) * group_size, num_geoms); ++i) {
        least = low[i] < least ? low[i] : least;
        greatest = high[i] > greatest ? high[i] : greatest;
      }
      min_[k].data()[group] = least;
      max_[k].data()[group] = greatest;
    }
    for (int group = num_groups_; group % T::num_lanes != 0; ++group)  // padding, which no box overlaps
      min_[k].data()[group] = static_cast<Scalar>(huge_bound);
  }
}

template <class T>
std::uint64_t GroupBoxes<T>::overlapping(const BoxLanes<T>& box, int first_group) const {
  std::uint64_t found = 0;
  for (int first = first_group / T::num_lanes * T::num_lanes; first < num_groups_; first += T::num_lanes)
    found |= static_cast<std::uint64_t>(box.overlapping(min_, max_, first)) << first;
  return found & ~std::uint64_t{0} << first_group;
}

}  // namespace pbmpi::solver
