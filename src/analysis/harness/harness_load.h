/// The properties of a run of whole worlds that decide what the harness sends, holds and waits for.
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
  double step_s = 0;     ///< per world, in its engine
  double variation = 0;  ///< standard deviation / mean of the costs of worlds in a frame

  /// Number of worlds that a rank owns.
  std::int64_t worlds_of(int rank) const {
    return num_worlds / num_ranks + (rank < num_worlds % num_ranks ? 1 : 0);
  }
};

/// How poses and costs reach root.
struct GatherShape {
  int radix = mpi::RankTree::usual_radix;
  std::int64_t piece_bytes = mpi::TreeGather::usual_piece_bytes;

  /// Each rank sends all its data to root in one message, as with MPI_Gatherv, for which Open MPI uses this
  /// algorithm on any number of ranks.
  static GatherShape linear(int num_ranks) { return {num_ranks < 2 ? 2 : num_ranks, std::int64_t{1} << 62}; }
};

}  // namespace pbmpi::analysis
