/// The cost of the big matrix of `direct` where running it would take too long.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "app/pbreport/instructions/counts.h"
#include "app/pbreport/suite/island_work.h"

namespace pbmpi::app {

/// The fewest rows of an island for the cubic part of its cost to dominate.
inline constexpr int leading_rows = 100;

/// Cost of the solver divided by the sum of rows^3 of the islands (IslandWork::cubed_rows()), over some
/// scenes.
struct CubicCost {
  double least = 0, middle = 0, most = 0;  ///< middle: the geometric mean
  int num_scenes = 0;
};

/// From the ratios above 0; empty without any.
std::optional<CubicCost> cubic_cost(std::span<const double> ratios);

/// Instructions per cubed row, from the scenes that were counted with direct and have an island of
/// `leading_rows`. `works`: with any stepper, since all see the same contacts in the first steps.
std::optional<CubicCost> counted_cost(const std::vector<CountedScene>& scenes,
                                      const std::vector<IslandWork>& works);

/// Instructions of a frame with direct: counted, or extrapolated with `cost`.
struct DirectCost {
  double least = 0, middle = 0, most = 0;
  bool is_counted = false;
};
/// Empty where direct was not counted and there is no cost, no work or no count of quick, whose collision
/// detection is the same.
std::optional<DirectCost> direct_cost(const CountedScene& scene, const std::optional<CubicCost>& cost,
                                      const std::vector<IslandWork>& works);

/// Null if there is none.
const IslandWork* find_work(const std::vector<IslandWork>& works, const std::string& scene);

}  // namespace pbmpi::app
