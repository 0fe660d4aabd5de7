/// Decides frame by frame whether worlds move: what root does with the costs that it gathers.
#pragma once

#include <span>
#include <vector>

#include "mpi/balance/rebalance.h"

namespace pbmpi::mpi {

/// Smooths the costs of the last frames and keeps a distance between two rebalances. Communicates nothing.
///
/// A world's cost is its median over the last 3 frames, so that one frame disturbed by something else on the
/// machine counts for nothing. The first decision falls after frame 2 (the first frame meets cold caches),
/// and after a rebalance 4 frames pass before the next one, in which the costs are measured on the new
/// owners.
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
