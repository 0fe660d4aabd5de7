#include "mpi/spaces/space_estimate.h"

#include "stepping/glide.h"

namespace pbmpi::mpi {

SpaceEstimate::SpaceEstimate(const Communicator& comm, stepping::SpaceStepper& stepper, ErrorHold& errors,
                             int steps_per_frame, double dt_s, std::optional<double> due_s)
    : comm_(&comm),
      stepper_(&stepper),
      step_(comm, stepper, errors),
      steps_per_frame_(steps_per_frame),
      dt_s_(dt_s) {
  if (due_s) plan_.emplace(*due_s);
}

SpaceEstimate::How SpaceEstimate::choose() {
  if (!plan_) return How::coarse;
  How how = How::glide;
  if (plan_->fits(0, steps_per_frame_, 0)) {
    how = How::precise;
  } else if (plan_->fits(0, 0, steps_per_frame_)) {
    how = How::coarse;
  }
  comm_->bcast_value(how);
  return how;
}

void SpaceEstimate::note_precise(double frame_s) {
  if (plan_) plan_->note_precise(frame_s / steps_per_frame_);
}

void SpaceEstimate::run(const SpaceOwnership& ownership, const model::State& start, std::int64_t step,
                        core::PhaseTimes& times) {
  const double start_s = core::now_s();
  core::LapTimer timer(times);
  step_.own(ownership, start, step);
  timer.lap(core::Phase::integrate);
  for (int i = 0; i < steps_per_frame_; ++i) step_.run(step + i, i + 1 == steps_per_frame_, times);
  steps_ = {.coarse = steps_per_frame_};
  if (plan_) plan_->note_coarse((core::now_s() - start_s) / steps_per_frame_);
  if (comm_->is_root()) state_ = stepper_->state();
}

void SpaceEstimate::glide(const model::State& start) {
  steps_ = {};
  if (plan_) plan_->skip_coarse();
  state_ = start;
  stepping::glide(steps_per_frame_ * dt_s_, state_);
}

void SpaceEstimate::take(const model::State& precise) {
  steps_ = {.precise = steps_per_frame_};
  state_ = precise;
}

}  // namespace pbmpi::mpi
