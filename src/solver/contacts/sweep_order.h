/// The order in which a sweep takes contacts.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "solver/contacts/manifold_order.h"

namespace pbmpi::solver {

/// The order of the colours, and of the points within a manifold. An order that is the same in all sweeps is
/// a bias that adds up: walls creep in one direction. A number's place follows from the key and the number
/// alone, so that the colours of a world come in the same order, however many colours the other worlds of its
/// pack have.
class SweepOrder {
 public:
  using Points = std::array<int, ManifoldOrder::most_points>;

  /// Puts colours and points in ascending order.
  void sort(int num_colors);
  void shuffle(int num_colors, std::uint64_t key);

  std::span<const int> colors() const { return colors_; }
  const Points& points() const { return points_; }

 private:
  std::vector<int> colors_;
  Points points_{};
};

}  // namespace pbmpi::solver
