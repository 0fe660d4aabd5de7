#include "solver/joints/broken_joints.h"

#include "core/error.h"
#include "model/state.h"

namespace pbmpi::solver {

void BrokenJoints::add_world() { worlds_.emplace_back(); }

bool BrokenJoints::contains(int world, int joint) const {
  const std::vector<std::int32_t>& known = worlds_[static_cast<std::size_t>(world)];
  return !known.empty() && known[static_cast<std::size_t>(joint)] != model::unbroken;
}

std::span<const int> BrokenJoints::find_fresh(int world, std::span<const std::int32_t> broken_in) {
  fresh_.clear();
  for (std::size_t i = 0; i < broken_in.size(); ++i) {
    const auto joint = static_cast<int>(i);
    const bool is_broken = broken_in[i] != model::unbroken;
    core::require_invariant(is_broken || !contains(world, joint), "a pack cannot mend a joint");
    if (is_broken && !contains(world, joint)) fresh_.push_back(joint);
  }
  return fresh_;
}

void BrokenJoints::set(int world, std::span<const std::int32_t> broken_in) {
  worlds_[static_cast<std::size_t>(world)].assign(broken_in.begin(), broken_in.end());
}

}  // namespace pbmpi::solver
