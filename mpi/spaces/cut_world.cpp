#include "mpi/spaces/cut_world.h"

#include <numeric>

#include "mpi/frame/state_transfer.h"

namespace pbmpi::mpi {

using core::Phase;

namespace {

void add(const core::PhaseTimes& own, core::PhaseTimes& times) {
  for (std::size_t phase = 0; phase < own.seconds.size(); ++phase) times.seconds[phase] += own.seconds[phase];
}

}  // namespace

SpaceEstimate::SpaceEstimate(const Communicator& comm, stepping::SpaceStepper& stepper, ErrorHold& errors,
                             int steps_per_frame)
    : comm_(&comm), stepper_(&stepper), step_(comm, stepper, errors), steps_per_frame_(steps_per_frame) {}

void SpaceEstimate::run(const SpaceOwnership& ownership, const model::State& start, std::int64_t step,
                        core::PhaseTimes& times) {
  core::LapTimer timer(times);
  step_.start_frame();
  step_.own(ownership, start, step);
  timer.lap(core::Phase::integrate);
  for (int i = 0; i < steps_per_frame_; ++i) step_.run(step + i, i + 1 == steps_per_frame_, times);
  if (comm_->is_root()) state_ = stepper_->state();
}

CutWorld::CutWorld(const Communicator& comm, stepping::SpaceStepper& stepper, ErrorHold& errors,
                   const WorldRunSettings& settings, std::vector<int> owners)
    : comm_(&comm),
      stepper_(&stepper),
      errors_(&errors),
      steps_per_frame_(settings.steps_per_frame),
      ownership_(stepper.map(), std::move(owners), comm.size()),
      step_(comm, stepper, errors),
      rebalancer_(stepper, settings.steps_per_frame, settings.rebalance_threshold) {}

void CutWorld::begin(const model::State& state, std::int64_t steps_done) {
  steps_done_ = steps_done;
  is_frozen_ = state.guard.frozen_in >= 0;
  now_.state = state;
  step_.own(ownership_, state, steps_done_);
}

void CutWorld::watch(int number, const stability::GuardSettings& settings) {
  if (!comm_->is_root()) return;
  // The stepper is borrowed and keeps the model alive as long as this is used.
  guard_.emplace(number, std::shared_ptr<const model::Model>(std::shared_ptr<void>(), &model()), settings);
  now_ = guard_->begin(now_.state);
  observables_ = now_.seen;
}

void CutWorld::estimate_with(const Communicator& comm, stepping::SpaceStepper& stepper) {
  estimate_ = std::make_unique<SpaceEstimate>(comm, stepper, *errors_, steps_per_frame_);
}

void CutWorld::estimate(core::PhaseTimes& times) {
  estimate_s_ = 0;
  if (is_frozen_) return estimate_->take(state());
  core::PhaseTimes own;
  estimate_->run(ownership_, state(), steps_done_, own);
  estimate_s_ = own.useful_s();
  add(own, times);
}

void CutWorld::advance(core::PhaseTimes& times) {
  core::PhaseTimes own;
  if (is_frozen_) {
    steps_done_ += steps_per_frame_;
  } else {
    step_frame(own);
  }
  frame_s_ = own.useful_s();
  add(own, times);
}

void CutWorld::step_frame(core::PhaseTimes& times) {
  core::LapTimer timer(times);
  // A rank without bodies only waits for the others, whichever phases it does that in.
  const bool idle = !comm_->is_root() && ownership_.bodies[comm_->rank()].empty();
  core::PhaseTimes unused;
  step_.start_frame();
  for (int i = 0; i < steps_per_frame_; ++i) {
    step_.run(steps_done_, i + 1 == steps_per_frame_, idle ? unused : times);
    if (hook_) hook_(steps_done_, step_.contacts());
    ++steps_done_;
  }
  if (idle) timer.lap(Phase::wait);
  if (!comm_->is_root()) return;
  core::LapTimer observing(times);
  observe();
  rebalancer_.note_times(step_.findings());
  end_watched_frame();
  observing.lap(Phase::islands);
}

void CutWorld::observe() {
  const FrameFindings& found = step_.findings();
  observables_ = found.seen;
  // Summed in the order of the bodies, which gives the sum of model::mechanical_energy(), bit for bit.
  observables_.energy_j = std::accumulate(found.energy_j.begin(), found.energy_j.end(), 0.0);
  stepping::observe_bodies(model(), state(), observables_);
}

void CutWorld::end_watched_frame() {
  if (!guard_ || errors_->failed()) return;
  errors_->guard([&] {
    is_mended_ = guard_->end_frame(now_, {state(), observables_}, steps_done_ - steps_per_frame_,
                                   steps_per_frame_, events_);
  });
  observables_ = now_.seen;
}

void CutWorld::share_mended() {
  const model::State state = share_state(*comm_, now_.state);
  step_.own(ownership_, state, steps_done_);
  is_frozen_ = state.guard.frozen_in >= 0;
  is_mended_ = false;
}

const model::State& CutWorld::saved_state() const { return guard_ ? now_.state : state(); }

const stepping::StepContacts* CutWorld::contacts() const {
  return is_frozen_ || !stepper_->shows_contacts() ? nullptr : &step_.findings().contacts;
}

std::int64_t CutWorld::plan_moves(bool may_move) {
  planned_ = {};
  if (is_frozen_) return 0;  // nothing was measured
  planned_ = rebalancer_.decide(step_.findings(), ownership_, step_.boxes(), comm_->size() > 1 && may_move);
  return std::ssize(planned_.moves);
}

void CutWorld::make_moves() {
  std::int64_t num_moves = std::ssize(planned_.moves);
  comm_->bcast_value(num_moves);
  if (num_moves == 0) return;
  planned_.moves.resize(num_moves);
  comm_->bcast(std::span(planned_.moves));
  std::vector<int> owner = ownership_.owner;
  for (const Move& move : planned_.moves) owner[move.part] = move.to;
  ownership_ = SpaceOwnership(stepper_->map(), std::move(owner), comm_->size());
  step_.own(ownership_, share_state(*comm_, state()), steps_done_);
  rebalancer_.forget_times();
}

core::Traffic CutWorld::take_traffic() {
  core::Traffic traffic = step_.take_traffic();
  if (!estimate_) return traffic;
  const core::Traffic of_estimate = estimate_->take_traffic();
  traffic.messages += of_estimate.messages;
  traffic.bytes += of_estimate.bytes;
  return traffic;
}

}  // namespace pbmpi::mpi
