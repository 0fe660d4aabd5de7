#include "estimate/short_run.h"

#include <algorithm>

namespace pbmpi::estimate {

void ShortRun::follow(std::span<const stepping::LocalWorld> worlds, std::int64_t step) {
  const auto stands = [](const stepping::LocalWorld& world) { return world.state->guard.frozen_in >= 0; };
  const auto is_here = [&](int id) {  // `worlds` is sorted
    const auto place = std::lower_bound(worlds.begin(), worlds.end(), id,
                                        [](const auto& world, int wanted) { return world.id < wanted; });
    return place != worlds.end() && place->id == id && !stands(*place);
  };
  for (auto known = worlds_.begin(); known != worlds_.end();) {
    if (is_here(*known)) {
      ++known;
    } else {
      stepper_->remove(*known);
      known = worlds_.erase(known);
    }
  }
  standing_.clear();
  for (const stepping::LocalWorld& world : worlds) {
    if (stands(world)) {
      standing_.emplace(world.id, *world.state);
    } else if (worlds_.contains(world.id)) {
      stepper_->set_state(world.id, *world.state, step);
    } else {
      stepper_->add(world.id, std::make_shared<const model::Model>(*world.model), *world.state, step);
      worlds_.insert(world.id);
    }
  }
}

void ShortRun::estimate(std::span<const stepping::LocalWorld> worlds, std::int64_t step, int num_steps,
                        core::PhaseTimes& times) {
  core::LapTimer timer(times);
  follow(worlds, step);
  timer.lap(core::Phase::integrate);
  if (!worlds.empty()) stepper_->advance(num_steps, times);
}

}  // namespace pbmpi::estimate
