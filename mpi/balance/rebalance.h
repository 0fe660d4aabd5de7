/// Which worlds move so that the loads of the ranks become even: pure data, without communication.
#pragma once

#include <span>
#include <vector>

#include "mpi/balance/partition.h"

namespace pbmpi::mpi {

/// What rebalance() found.
struct Rebalancing {
  std::vector<Move> moves;      ///< by ascending world; empty = stay
  double imbalance_before = 1;  ///< max/avg load
  double imbalance_after = 1;   ///< max/avg load that the moves promise
};

/// Moves few worlds so that the loads become even, or none: if max/avg does not pass `threshold` (>= 1), or
/// if no placement within reach takes off the makespan at least half of what the threshold tolerates (so
/// that noise in the costs does not move worlds back and forth).
///
/// From the most loaded rank a world moves to the least loaded one, that which best evens out the two; where
/// no world does, two worlds of unlike cost are swapped. This goes on until max/avg lies in the lower half of
/// what the threshold tolerates, or nothing helps. The makespan is never worse than before.
Rebalancing rebalance(std::span<const int> placement, std::span<const double> cost, int num_ranks,
                      double threshold);

}  // namespace pbmpi::mpi
