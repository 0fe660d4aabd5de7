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

/// Smooths the costs of the last frames and keeps a minimum distance between rebalances. Communicates
/// nothing.
///
/// A world's cost is its median over the last 3 frames, so a single frame disturbed by something else on the
/// machine does not count. The first decision falls after frame 2 (the first frame runs with cold caches).
/// After a rebalance 4 frames pass before the next decision, and the costs are measured on the new owners.
class Rebalancer {
 public:
  static constexpr int window = 3;      ///< frames that are smoothed over
  static constexpr int min_frames = 2;  ///< frames before the first decision
  static constexpr int cooldown = 4;    ///< frames without a decision after a rebalance

  /// `threshold` >= 1: max/avg load beyond which worlds move; infinity = never.
  Rebalancer(int num_ranks, double threshold) : num_ranks_(num_ranks), threshold_(threshold) {}

  /// Takes in a frame's costs [num_worlds] in seconds and returns the moves to make now, if any.
  Rebalancing frame_done(std::span<const double> cost_s, std::span<const int> placement);

  /// The median cost of each world over the window [num_worlds], s.
  std::vector<double> smoothed() const;

 private:
  int num_ranks_;
  double threshold_;
  int frames_until_decision_ = min_frames;
  std::size_t next_slot_ = 0;
  std::vector<std::vector<double>> recent_;  ///< [<= window][num_worlds], a ring
};

}  // namespace pbmpi::mpi
