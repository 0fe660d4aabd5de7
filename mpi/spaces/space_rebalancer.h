/// Decides when spaces change their owner, and to which rank, from the findings of the frames.
#pragma once

#include <cstddef>
#include <vector>

#include "core/clock.h"
#include "mpi/spaces/plan/reassign_spaces.h"
#include "mpi/spaces/plan/space_ownership.h"
#include "mpi/spaces/step/frame_report.h"
#include "stepping/space_stepper.h"

namespace pbmpi::mpi {

/// Used on root, by SpaceDriver; sends nothing. The first decision falls after frame 2 (the first frame runs
/// with cold caches), and 4 frames pass between two; where spaces have moved, the new owners are timed in
/// them. Each phase counts with its least seconds over the last 3 frames under the present owners: the
/// machine can make a rank wait in one frame, but never saves it work.
class SpaceRebalancer {
 public:
  /// `stepper` is borrowed. `threshold` >= 1; infinity = never.
  SpaceRebalancer(stepping::SpaceStepper& stepper, int steps_per_frame, double threshold)
      : stepper_(&stepper), steps_per_frame_(steps_per_frame), threshold_(threshold) {}

  /// To be called after each frame.
  void note_times(const FrameFindings& findings);
  /// After note_times(): which spaces move now, if any. `may_move`: there are other ranks, and another frame.
  /// `boxes` [num_spaces]
  Reassignment decide(const FrameFindings& findings, const SpaceOwnership& ownership,
                      std::span<const geometry::Box> boxes, bool may_move);
  /// To be called when spaces have moved.
  void forget_times() { last_times_.clear(); }

 private:
  static constexpr int frames_before_decisions = 2;
  static constexpr int frames_between_decisions = 4;
  static constexpr std::size_t window = 3;  ///< frames

  /// [num_ranks] seconds a frame by phase, the least of the last frames for each phase.
  std::vector<core::PhaseTimes> least_times() const;

  stepping::SpaceStepper* stepper_;
  int steps_per_frame_;
  double threshold_;
  int frames_until_decision_ = frames_before_decisions;
  std::vector<std::vector<core::PhaseTimes>> last_times_;  ///< [<= window][num_ranks] with present owners
};

}  // namespace pbmpi::mpi
