/// How many worlds lie in each pack.
#pragma once

#include <cstdint>
#include <vector>

#include "stepping/stepper.h"

namespace pbmpi::solver {

/// Deals worlds out to packs: whole batches of lanes each, but for the last one's last, and of each pack as
/// many as of any other, or one more. As many packs as asked for, if there are batches for them: at least
/// one.
class GroupPlan {
 public:
  GroupPlan(int num_worlds, int num_packs, int num_lanes);

  int num_packs() const { return num_packs_; }
  /// The sizes of all packs, [num_packs()].
  std::vector<int> sizes() const;
  /// Would a pack of so many worlds, full to the last lane, be one of them?
  bool contains(int size) const;

 private:
  int num_worlds_, num_lanes_, num_batches_, num_packs_;
};

/// As many packs as a core's cache asks for, times what it takes to have one for each of `num_threads`.
/// `share`: of all bodies of the stepper are `num_bodies`.
int packs_for(std::int64_t num_bodies, double share, stepping::Precision precision, int num_threads);

}  // namespace pbmpi::solver
