#include "mpi/spaces/space_estimate.h"

namespace pbmpi::mpi {

SpaceEstimate::SpaceEstimate(const Communicator& comm, stepping::SpaceStepper& stepper, ErrorHold& errors,
                             int steps_per_frame)
    : comm_(&comm), stepper_(&stepper), step_(comm, stepper, errors), steps_per_frame_(steps_per_frame) {}

void SpaceEstimate::run(const SpaceOwnership& ownership, const model::State& start, std::int64_t step,
                        core::PhaseTimes& times) {
  core::LapTimer timer(times);
  step_.own(ownership, start, step);
  timer.lap(core::Phase::integrate);
  for (int i = 0; i < steps_per_frame_; ++i) step_.run(step + i, i + 1 == steps_per_frame_, times);
  if (comm_->is_root()) state_ = stepper_->state();
}

}  // namespace pbmpi::mpi
