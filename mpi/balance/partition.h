/// Which rank owns which world: pure data, known to no communicator. Every function is deterministic (ties go
/// to the lower world and the lower rank), so that all ranks may compute the same placement.
#pragma once

#include <span>
#include <vector>

namespace pbmpi::mpi {

/// [num_worlds] the rank that owns each world.
using Placement = std::vector<int>;

/// Contiguous blocks of equal counts; the first num_worlds % num_ranks ranks own one world more.
Placement equal_placement(int num_worlds, int num_ranks);

/// Longest processing time first: by falling cost, each world goes to the least loaded rank. The makespan is
/// at most 4/3 - 1/(3 num_ranks) times the best one (Graham, "Bounds on multiprocessing timing anomalies",
/// SIAM J. Appl. Math. 17, 1969). `cost` [num_worlds], any unit, finite and not negative.
Placement lpt_placement(std::span<const double> cost, int num_ranks);

/// [num_ranks] sum of the costs of each rank's worlds, added in order of world.
std::vector<double> rank_loads(std::span<const int> placement, std::span<const double> cost, int num_ranks);

/// Largest over average load; 1 if nothing costs anything.
double imbalance(std::span<const double> loads);

/// One world that changes its owner.
struct Move {
  int world = 0;
  int to = 0;
};

/// What rebalance() found.
struct Rebalancing {
  std::vector<Move> moves;      ///< by ascending world; empty = stay
  double imbalance_before = 1;  ///< max/avg load
  double imbalance_after = 1;   ///< max/avg load that the moves promise
};

/// Moves few worlds so that the loads become even, or none: if max/avg does not pass `threshold` (>= 1), or
/// if no placement within reach takes off the makespan at least half of what the threshold tolerates (so
/// that noise in the costs does not send worlds to and fro).
///
/// From the most loaded rank a world moves to the least loaded one, that which best evens out the two; where
/// no world does, two worlds of unlike cost are swapped. This goes on until max/avg lies in the lower half of
/// what the threshold tolerates, or nothing helps. The makespan is never worse than before.
Rebalancing rebalance(std::span<const int> placement, std::span<const double> cost, int num_ranks,
                      double threshold);

}  // namespace pbmpi::mpi
