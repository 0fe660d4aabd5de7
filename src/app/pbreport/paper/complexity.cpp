#include "app/pbreport/paper/complexity.h"

#include <algorithm>
#include <cmath>

#include "app/pbreport/instructions/direct_cost.h"

namespace pbmpi::app {

std::optional<Growth> growth_of(const std::vector<IslandWork>& works) {
  Growth growth;
  double x_sum = 0, y_sum = 0, xx_sum = 0, xy_sum = 0;
  for (const IslandWork& work : works) {
    for (const std::vector<SolvedIsland>& step : work.islands) {
      for (const SolvedIsland& island : step) {
        if (island.rows < leading_rows || island.solve_s <= 0) continue;
        const double x = std::log(island.rows), y = std::log(island.solve_s);
        x_sum += x;
        y_sum += y;
        xx_sum += x * x;
        xy_sum += x * y;
        growth.least_rows = growth.num_islands == 0 ? island.rows : std::min(growth.least_rows, island.rows);
        growth.most_rows = std::max(growth.most_rows, island.rows);
        ++growth.num_islands;
      }
    }
  }
  if (growth.num_islands == 0 || growth.most_rows < 4 * growth.least_rows) return std::nullopt;
  const double n = growth.num_islands;
  growth.exponent = (n * xy_sum - x_sum * y_sum) / (n * xx_sum - x_sum * x_sum);
  return growth;
}

double time_of_a_row(const IslandWork& work) {
  double seconds = 0, rows = 0;
  for (const std::vector<SolvedIsland>& step : work.islands) {
    for (const SolvedIsland& island : step) {
      seconds += island.solve_s;
      rows += island.rows;
    }
  }
  return rows > 0 ? seconds / rows : 0;
}

}  // namespace pbmpi::app
