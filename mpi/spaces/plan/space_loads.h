/// What each rank has to do if it owns some spaces: pure data, without communication.
#pragma once

#include <span>
#include <vector>

namespace pbmpi::mpi {

/// Cost of solving islands. Units cost by the batch and are therefore counted; contacts cost one by one.
struct SolverWork {
  std::vector<int> units;  ///< [num_shapes] units of each shape, which fill the solver's lanes together
  double contacts_s = 0;   ///< seconds a frame for the contacts' rows
  int bodies = 0;

  void add(const SolverWork& other, int sign = 1);  ///< takes it away with -1
};

/// The part of an island that lies in one space.
struct SpacePart {
  int space = 0;
  SolverWork work;
};

/// What root has to look at where spaces of different ranks are near each other.
struct SpaceBorder {
  int bodies = 0;
  std::vector<int> neighbours;  ///< spaces whose boxes overlap its own
};

/// The work of one rank's solver, in weights, and the seconds it took.
struct RankSample {
  double batches = 0, contacts = 0;
  double seconds = 0;
};

/// Seconds per unit of weight.
struct SolverCosts {
  double batches = 0, contacts = 0;
};

/// The work of a frame, independent of which rank did it.
struct SpaceLoads {
  int num_lanes = 1;
  std::vector<double> batch_s;     ///< [num_shapes] seconds a frame for a batch of up to num_lanes units
  std::vector<double> collide_s;   ///< [num_spaces]
  std::vector<SolverWork> inside;  ///< [num_spaces] work of islands that lie in one space
  std::vector<std::vector<SpacePart>> islands;  ///< parts of islands that lie in several spaces
  double root_extra_s = 0;                      ///< root's section, but for what the next two make of it
  std::vector<SpaceBorder> borders;             ///< [num_spaces]; empty: nothing is near
  double cross_s = 0;  ///< seconds a frame on root for a body of a space near one of another rank
  double ship_s = 0;   ///< seconds a frame for shipping a body there and back, on each of the two ranks

  double seconds(const SolverWork& work) const;  ///< the work's time on one rank
  void scale(const SolverCosts& costs);          ///< from weights to seconds
};

/// The rank that solves an island of several spaces: that with most of its bodies, the lowest on a tie.
/// `scratch` [num_ranks] is zeros before and after.
int solver_of(std::span<const SpacePart> island, std::span<const int> owner, std::span<int> scratch);

/// Does another rank own one of these neighbours of the space?
bool is_near_others(std::span<const int> neighbours, std::span<const int> owner, int space);

/// Least-squares fit of the two costs to the ranks' seconds. Where the ranks do not differ enough to tell the
/// two costs apart, both get the same value.
SolverCosts fit_costs(std::span<const RankSample> ranks);

}  // namespace pbmpi::mpi
