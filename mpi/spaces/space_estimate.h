/// The estimate of a world that is cut into spaces (FEEC).
#pragma once

#include <cstdint>
#include <optional>

#include "core/clock.h"
#include "core/traffic.h"
#include "model/state.h"
#include "mpi/comm/agreement.h"
#include "mpi/comm/communicator.h"
#include "mpi/spaces/plan/space_ownership.h"
#include "mpi/spaces/step/space_step.h"
#include "stepping/deadline_plan.h"
#include "stepping/frame.h"
#include "stepping/space_stepper.h"

namespace pbmpi::mpi {

/// A short run by all ranks together, with a stepper and messages of its own, from the precise state of the
/// previous frame. With a deadline root chooses for all ranks: the precise frame itself if that fits, else
/// the short run, else motion without forces.
class SpaceEstimate {
 public:
  enum class How : std::int32_t { precise, coarse, glide };

  /// All borrowed. `due_s`: from the start of a frame until its estimate is due.
  SpaceEstimate(const Communicator& comm, stepping::SpaceStepper& stepper, ErrorHold& errors,
                int steps_per_frame, double dt_s, std::optional<double> due_s);

  /// How the next frame is estimated. Collective with a deadline.
  How choose();
  /// Tells root how long a precise frame took.
  void note_precise(double frame_s);

  /// Collective. Estimates the frame from `start`, the rank's copy of the precise state at the start of
  /// `step`: root needs all rows, the other ranks those of their own spaces.
  void run(const SpaceOwnership& ownership, const model::State& start, std::int64_t step,
           core::PhaseTimes& times);
  void glide(const model::State& start);
  /// Takes this precise state, after the frame, as the estimate.
  void take(const model::State& precise);

  const model::State& state() const { return state_; }  ///< of the last estimate, on root
  stepping::EstimatedSteps steps() const { return steps_; }
  core::Traffic take_traffic() { return step_.take_traffic(); }

 private:
  const Communicator* comm_;
  stepping::SpaceStepper* stepper_;
  SpaceStep step_;
  int steps_per_frame_;
  double dt_s_;
  std::optional<stepping::DeadlinePlan> plan_;  ///< used on root
  model::State state_;
  stepping::EstimatedSteps steps_;
};

}  // namespace pbmpi::mpi
