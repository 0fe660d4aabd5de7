#include "estimate/same_solve.h"

#include "core/error.h"

namespace pbmpi::estimate {

void SameSolve::estimate(std::span<const stepping::LocalWorld> worlds, std::int64_t step, int num_steps,
                         core::PhaseTimes& times) {
  static_cast<void>(step);  // the stepper is already at this step
  core::require_invariant(num_steps == 1, "an estimate from the same solve is of one step");
  if (worlds.empty()) return;
  stepper_->begin_step(iterations_, times);
  for (const stepping::LocalWorld& world : worlds) looks_[world.id] = stepper_->look(world.id);
}

}  // namespace pbmpi::estimate
