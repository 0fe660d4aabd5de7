/// How the time of an island grows with its rows.
#pragma once

#include <optional>
#include <vector>

#include "app/pbreport/suite/island_work.h"

namespace pbmpi::app {

/// Power law through the times of all islands of at least `leading_rows` rows.
struct Growth {
  double exponent = 0;  ///< least squares of log(seconds) over log(rows)
  int num_islands = 0, least_rows = 0, most_rows = 0;
};

/// Empty unless the largest island has four times the rows of the smallest.
std::optional<Growth> growth_of(const std::vector<IslandWork>& works);

/// Seconds of all islands divided by their rows; 0 without rows.
double time_of_a_row(const IslandWork& work);

}  // namespace pbmpi::app
