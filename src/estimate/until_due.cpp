#include "estimate/until_due.h"

#include "core/clock.h"
#include "estimate/partly_precise.h"
#include "stepping/glide.h"

namespace pbmpi::estimate {

void UntilDue::estimate(std::span<const stepping::LocalWorld> worlds, std::int64_t step, int num_steps,
                        core::PhaseTimes& times) {
  const double start_s = core::now_s();
  note_last_frame(worlds, step, num_steps);
  steps_ = {};
  held_.clear();
  if (worlds.empty()) return;
  begin_precise(start_s, num_steps, times);
  finish(begun_worlds(*precise_, worlds), start_s, step + steps_.precise, num_steps - steps_.precise, times);
}

void UntilDue::note_last_frame(std::span<const stepping::LocalWorld> worlds, std::int64_t step,
                               int num_steps) {
  double cost_s = 0;
  for (const stepping::LocalWorld& world : worlds) cost_s += precise_->cost_s(world.id);
  if (next_step_ == step) plan_.note_precise(cost_s / num_steps);
  next_step_ = step + num_steps;
}

void UntilDue::begin_precise(double start_s, int num_steps, core::PhaseTimes& times) {
  while (steps_.precise < num_steps &&
         plan_.fits(core::now_s() - start_s, 1, num_steps - steps_.precise - 1)) {
    precise_->begin_frame(1, times);
    ++steps_.precise;
  }
}

void UntilDue::finish(std::span<const stepping::LocalWorld> worlds, double start_s, std::int64_t step,
                      int num_steps, core::PhaseTimes& times) {
  const double now_s = core::now_s();
  if (num_steps > 0 && plan_.fits(now_s - start_s, 0, num_steps)) {
    rest_->estimate(worlds, step, num_steps, times);
    plan_.note_coarse((core::now_s() - now_s) / num_steps);
    steps_.coarse = num_steps;
    return;
  }
  // Copies: a guard may still take a world out of the precise stepper, and the estimate must not change.
  for (const stepping::LocalWorld& world : worlds) held_.emplace(world.id, *world.state);
  if (num_steps == 0) return;
  plan_.skip_coarse();
  glide(num_steps, times);
}

void UntilDue::glide(int num_steps, core::PhaseTimes& times) {
  core::LapTimer timer(times);
  for (auto& [world, state] : held_) {
    if (state.guard.frozen_in < 0) stepping::glide(num_steps * dt_s_, state);
  }
  timer.lap(core::Phase::integrate);
}

}  // namespace pbmpi::estimate
