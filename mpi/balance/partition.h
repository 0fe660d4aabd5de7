/// Which rank owns which world: pure data, without communication. Every function is deterministic (ties go to
/// the lower world and the lower rank), so all ranks may compute the same placement.
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

/// A change of owner: of a world, or of a space of a world that is cut into spaces.
struct Move {
  int part = 0;  ///< the world or space
  int to = 0;    ///< the rank that owns it afterwards
};

}  // namespace pbmpi::mpi
