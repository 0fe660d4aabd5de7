/// Which worlds move so that the loads of the ranks become even: pure data, without communication.
#pragma once

#include <span>
#include <vector>

#include "mpi/balance/partition.h"

namespace pbmpi::mpi {

/// The result of rebalance().
struct Rebalancing {
  std::vector<Move> moves;      ///< by ascending world; empty = stay
  double imbalance_before = 1;  ///< max/avg load
  double imbalance_after = 1;   ///< max/avg load predicted after the moves
};

/// Moves few worlds to even out the loads. Moves none if max/avg does not exceed `threshold` (>= 1), or if no
/// placement within reach lowers the makespan by at least half of what the threshold tolerates (otherwise
/// noise in the costs would move worlds back and forth).
///
/// A world moves from the most loaded rank to the least loaded one: the world that best evens out the two.
/// Where no such move helps, two worlds of different cost are swapped. This goes on until max/avg lies in the
/// lower half of what the threshold tolerates, or nothing helps. The makespan is never worse than before.
Rebalancing rebalance(std::span<const int> placement, std::span<const double> cost, int num_ranks,
                      double threshold);

}  // namespace pbmpi::mpi
