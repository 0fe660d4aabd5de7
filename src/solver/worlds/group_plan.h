/// How many worlds each pack holds.
#pragma once

#include <cstdint>
#include <vector>

#include "stepping/stepper.h"

namespace pbmpi::solver {

/// Deals worlds out to packs in whole batches of lanes, except for the very last batch; the numbers of
/// batches of any two packs differ by at most one. There are as many packs as asked for, if there are enough
/// batches, and at least one.
class GroupPlan {
 public:
  GroupPlan(int num_worlds, int num_packs, int num_lanes);

  int num_packs() const { return num_packs_; }
  /// The sizes of all packs, [num_packs()].
  std::vector<int> sizes() const;
  /// Does the plan have a pack of `size` worlds that is full to the last lane?
  bool contains(int size) const;

 private:
  int num_worlds_, num_lanes_, num_batches_, num_packs_;
};

/// As many packs as a core's cache asks for, times what it takes to have one for each of `num_threads`.
/// `share`: the part that `num_bodies` are of all bodies of the stepper.
int packs_for(std::int64_t num_bodies, double share, stepping::Precision precision, int num_threads);

}  // namespace pbmpi::solver
