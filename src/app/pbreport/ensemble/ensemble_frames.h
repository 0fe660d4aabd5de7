/// Observables of an ensemble, frame by frame.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "app/pbreport/ensemble/ensemble_runs.h"
#include "app/pbreport/ensemble/spread.h"

namespace pbmpi::app {

struct QuantitySpread {
  std::string name, unit;
  std::vector<Spread> by_frame;  ///< [num_frames]
};

/// Each observable of worlds (a vector by its components) and, where samples are runs, the times of frames.
/// Worlds are joined as stepping/observable_table.h says.
std::vector<QuantitySpread> spread_by_frame(const EnsembleRuns& ensemble,
                                            const std::vector<double>& quantiles);

/// Values of a world over the measured frames.
struct WorldFacts {
  std::size_t run = 0;
  std::int64_t world = 0;  ///< its number in the ensemble
  double contacts_mean = 0, contacts_max = 0, rows_mean = 0, rows_max = 0, islands_mean = 0;
  double energy_first_j = 0, energy_last_j = 0, penetration_max_m = 0, joint_gap_max_m = 0;
  /// [s] per step, mean: collision detection, and the world's islands one after the other; NaN without
  /// --record-islands.
  double collide_s = 0, solve_s = 0;
};
std::vector<WorldFacts> facts_of_worlds(const EnsembleRuns& ensemble);

}  // namespace pbmpi::app
