/// What each rank has to do under an ownership of spaces, kept up to date at the cost of what changes: pure
/// data, without communication.
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "mpi/balance/partition.h"
#include "mpi/spaces/plan/space_loads.h"

namespace pbmpi::mpi {

/// Predicted seconds of one rank in a frame.
struct RankLoad {
  double collide_s = 0;  ///< on root its own section is included
  double solve_s = 0;    ///< shipping included
};

struct PredictedLoads {
  std::vector<RankLoad> ranks;  ///< [num_ranks]
  bool ships = false;           ///< does an island cross ranks?

  /// Seconds of the frame. Where nothing is shipped, a rank goes on to collide as soon as it has solved its
  /// islands; where islands are shipped, the ranks wait for each other between collision and solver.
  double makespan_s() const;
};

/// Predicts the loads under an ownership, `owner` [num_spaces]: an island of several ranks is solved on the
/// rank of its largest part, and its other parts are shipped there.
PredictedLoads predict_loads(const SpaceLoads& loads, std::span<const int> owner, int num_ranks);

/// The predicted loads of an ownership, and what a few moves would make of them.
class LoadLedger {
 public:
  /// Borrows `loads`.
  LoadLedger(const SpaceLoads& loads, std::span<const int> owner, int num_ranks);

  void set(std::span<const int> owner);
  const std::vector<int>& owner() const { return owner_; }
  PredictedLoads loads() const;
  /// Does the island cross ranks?
  bool ships(int island) const;

  /// Lower is better: the makespan, and a little of the sum and of the spread of the ranks' times.
  double rating() const;
  /// The rating after these moves, which are undone again.
  double rating_after(std::span<const Move> moves);

 private:
  struct Rank {
    double collide_s = 0;
    SolverWork work;
    double ship_s = 0;
    double solve_s = 0;  ///< shipping included
  };

  void find_touched(std::span<const Move> moves);
  void keep(int rank);
  void put(std::span<const Move> moves, int sign);
  void put_border(int space, int sign);
  void put_space(int space, int sign);
  void put_island(int island, int sign);

  const SpaceLoads& loads_;
  std::vector<std::vector<int>> islands_of_space_;
  std::vector<int> owner_;
  std::vector<Rank> ranks_;
  int num_shipped_ = 0;  ///< islands
  // Scratch.
  std::vector<int> bodies_;             ///< [num_ranks] zeros
  std::vector<int> islands_, borders_;  ///< that the moves touch
  std::vector<int> before_;
  std::vector<std::pair<int, Rank>> saved_;
};

}  // namespace pbmpi::mpi
