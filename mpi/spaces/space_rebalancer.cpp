#include "mpi/spaces/space_rebalancer.h"

#include <algorithm>

#include "mpi/spaces/load_measurement.h"

namespace pbmpi::mpi {

void SpaceRebalancer::note_times(const FrameFindings& findings) {
  if (last_times_.size() == window) last_times_.erase(last_times_.begin());
  last_times_.push_back(findings.times);
}

std::vector<core::PhaseTimes> SpaceRebalancer::least_times() const {
  std::vector<core::PhaseTimes> least = last_times_.front();
  for (const std::vector<core::PhaseTimes>& frame : last_times_) {
    for (std::size_t rank = 0; rank < least.size(); ++rank) {
      for (std::size_t phase = 0; phase < core::num_phases; ++phase)
        least[rank].seconds[phase] = std::min(least[rank].seconds[phase], frame[rank].seconds[phase]);
    }
  }
  return least;
}

Reassignment SpaceRebalancer::decide(const FrameFindings& findings, const SpaceOwnership& ownership,
                                     bool may_move) {
  frames_until_decision_ = std::max(0, frames_until_decision_ - 1);
  if (!may_move || frames_until_decision_ > 0) return {};
  const std::vector<core::PhaseTimes> times = least_times();
  const SpaceLoads loads =
      measure_loads({stepper_, stepper_->field(), &ownership, &findings, times, steps_per_frame_});
  Reassignment plan =
      reassign_spaces(loads, ownership.owner, static_cast<int>(ownership.spaces.size()), threshold_);
  if (!plan.moves.empty()) frames_until_decision_ = frames_between_decisions + 1;
  return plan;
}

}  // namespace pbmpi::mpi
