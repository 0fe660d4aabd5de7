/// A run of whole worlds, as far as what the harness sends, holds and waits for depends on it.
#pragma once

#include <cstdint>

#include "mpi/comm/rank_tree.h"
#include "mpi/comm/tree_gather.h"

namespace pbmpi::analysis {

/// All worlds are alike, and each rank owns a block of them: mpi::equal_placement().
struct HarnessLoad {
  int num_ranks = 1;
  std::int64_t num_worlds = 1;
  std::int64_t bodies_each = 1;
  int steps_per_frame = 3;
  double step_s = 0;     ///< of a world, in its engine
  double variation = 0;  ///< standard deviation over the mean of what worlds cost in a frame

  /// Of a rank.
  std::int64_t worlds_of(int rank) const {
    return num_worlds / num_ranks + (rank < num_worlds % num_ranks ? 1 : 0);
  }
};

/// How poses and costs come to root.
struct GatherShape {
  int radix = mpi::RankTree::usual_radix;
  std::int64_t piece_bytes = mpi::TreeGather::usual_piece_bytes;

  /// Each rank sends all that it has to root in one message, as with MPI_Gatherv, whose algorithm in Open MPI
  /// is this one for any number of ranks.
  static GatherShape linear(int num_ranks) { return {num_ranks < 2 ? 2 : num_ranks, std::int64_t{1} << 62}; }
};

}  // namespace pbmpi::analysis
