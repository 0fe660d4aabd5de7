/// Finds better owners of spaces from the predicted loads: pure data, without communication.
#pragma once

#include <span>
#include <vector>

#include "mpi/balance/partition.h"
#include "mpi/spaces/plan/space_loads.h"

namespace pbmpi::mpi {

struct Reassignment {
  std::vector<Move> moves;  ///< by ascending space; empty = stay
  double makespan_before_s = 0;
  double makespan_after_s = 0;
};

/// Local search for an ownership that makes the frame shorter, starting from the present one. It makes the
/// best change of the ranks that take longest as long as one helps: moving a space, bringing
/// the spaces of an island together, or else swapping two spaces, or all spaces of two ranks. Nothing moves
/// if the predicted gain is less than half of `threshold` - 1. Deterministic: ties go to the lower space and
/// rank. A change is rated at the cost of the spaces and islands that it touches, not of all.
Reassignment reassign_spaces(const SpaceLoads& loads, std::span<const int> owner, int num_ranks,
                             double threshold);

}  // namespace pbmpi::mpi
