/// The estimate of a world that is cut into spaces (FEEC).
#pragma once

#include <cstdint>

#include "core/clock.h"
#include "core/traffic.h"
#include "model/state.h"
#include "mpi/comm/agreement.h"
#include "mpi/comm/communicator.h"
#include "mpi/spaces/plan/space_ownership.h"
#include "mpi/spaces/step/space_step.h"
#include "stepping/space_stepper.h"

namespace pbmpi::mpi {

/// A short run by all ranks together, with a stepper and messages of its own, from the precise state of the
/// previous frame.
class SpaceEstimate {
 public:
  /// All borrowed.
  SpaceEstimate(const Communicator& comm, stepping::SpaceStepper& stepper, ErrorHold& errors,
                int steps_per_frame);

  /// Collective. Estimates the frame from `start`, the rank's copy of the precise state at the start of
  /// `step`: root needs all rows, the other ranks those of their own spaces.
  void run(const SpaceOwnership& ownership, const model::State& start, std::int64_t step,
           core::PhaseTimes& times);
  /// Takes this precise state as the estimate: that of a world that stands still.
  void take(const model::State& precise) { state_ = precise; }

  const model::State& state() const { return state_; }  ///< of the last estimate, on root
  core::Traffic take_traffic() { return step_.take_traffic(); }

 private:
  const Communicator* comm_;
  stepping::SpaceStepper* stepper_;
  SpaceStep step_;
  int steps_per_frame_;
  model::State state_;
};

}  // namespace pbmpi::mpi
