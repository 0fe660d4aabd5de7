#include "api/seeded_steppers.h"

#include <utility>

#include "core/clock.h"

namespace pbmpi::api {

void SeededSteppers::add(int world, std::uint64_t solver_seed, std::shared_ptr<const model::Model> model,
                         const model::State& state, std::int64_t step) {
  Seat& seat = by_seed_[solver_seed];
  if (!seat.stepper) seat.stepper = make_stepper_(solver_seed);
  seat.stepper->add(world, std::move(model), state, step);
  ++seat.num_worlds;
  seats_[world] = &seat;
}

void SeededSteppers::remove(int world) {
  Seat& seat = *seats_.at(world);
  seat.stepper->remove(world);
  seats_.erase(world);
  if (--seat.num_worlds == 0)
    std::erase_if(by_seed_, [](const auto& other) { return other.second.num_worlds == 0; });
}

void SeededSteppers::advance(int num_steps) {
  core::PhaseTimes times;
  for (auto& [seed, seat] : by_seed_) seat.stepper->advance(num_steps, times);
}

}  // namespace pbmpi::api
