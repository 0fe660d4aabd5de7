/// Which rank should own which space: pure data, known to no communicator.
#pragma once

#include <span>
#include <vector>

#include "mpi/balance/partition.h"

namespace pbmpi::mpi {

/// What solving islands costs, as far as it can be summed up.
struct SolverWork {
  std::vector<int> units;  ///< [num_shapes]: equal units fill the solver's lanes
  double contacts_s = 0;   ///< seconds a frame
  int bodies = 0;

  void add(const SolverWork& other);
};

/// The part of an island that lies in one space.
struct SpacePart {
  int space = 0;
  SolverWork work;
};

/// What one rank's solver had to do, by weights, and how long it took.
struct RankSample {
  double batches = 0, contacts = 0;
  double seconds = 0;
};

/// Seconds of a unit of weight.
struct SolverCosts {
  double batches = 0, contacts = 0;
};

/// What a frame has shown of the work, whoever did it.
struct SpaceLoads {
  int num_lanes = 1;
  std::vector<double> batch_s;     ///< [num_shapes] of up to num_lanes units of a shape, seconds a frame
  std::vector<double> collide_s;   ///< [num_spaces]
  std::vector<SolverWork> inside;  ///< [num_spaces] of islands that lie in one space
  std::vector<std::vector<SpacePart>> islands;  ///< that lie in several spaces
  double root_extra_s = 0;                      ///< root's section
  double ship_s = 0;  ///< of passing a body to another rank and back, each of the two

  double seconds(const SolverWork& work) const;  ///< on one rank
  void scale(const SolverCosts& costs);          ///< from weights to seconds
};

/// What one rank would do in such a frame.
struct RankLoad {
  double collide_s = 0;  ///< and root's section
  double solve_s = 0;    ///< and what is shipped
};

struct PredictedLoads {
  std::vector<RankLoad> ranks;  ///< [num_ranks]
  bool ships = false;           ///< does an island cross ranks?

  /// Seconds of the frame. Where nothing is shipped a rank goes on to collide when it has solved its islands;
  /// where something is, the ranks wait for each other in between.
  double makespan_s() const;
};

/// If the spaces were owned like this: an island of several ranks is solved where its largest part lies, and
/// its other parts are shipped there.
PredictedLoads predict_loads(const SpaceLoads& loads, std::span<const int> owner, int num_ranks);

/// The least squares of the ranks' seconds; where the ranks do not differ enough to tell the two apart, both
/// get the same cost.
SolverCosts fit_costs(std::span<const RankSample> ranks);

struct Reassignment {
  std::vector<Move> moves;  ///< by ascending space; empty = stay
  double makespan_before_s = 0;
  double makespan_after_s = 0;
};

/// Looks for an ownership under which the busiest rank has less to do, from the present one by single moves,
/// by swaps, of all spaces of two ranks, too, and by bringing the spaces of an island together, as long as
/// one helps. Stays if that promises less than half of `threshold` - 1. Deterministic: ties go to the lower
/// space and rank.
Reassignment reassign_spaces(const SpaceLoads& loads, std::span<const int> owner, int num_ranks,
                             double threshold);

}  // namespace pbmpi::mpi
