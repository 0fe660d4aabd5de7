#include "estimate/partly_precise.h"

namespace pbmpi::estimate {

void PartlyPrecise::estimate(std::span<const stepping::LocalWorld> worlds, std::int64_t step, int num_steps,
                             core::PhaseTimes& times) {
  if (!worlds.empty()) precise_->begin_frame(num_precise_, times);
  rest_->estimate(begun_worlds(*precise_, worlds), step + num_precise_, num_steps - num_precise_, times);
}

std::vector<stepping::LocalWorld> begun_worlds(const stepping::FrameStepper& precise,
                                               std::span<const stepping::LocalWorld> worlds) {
  std::vector<stepping::LocalWorld> begun(worlds.begin(), worlds.end());
  for (stepping::LocalWorld& world : begun) world.state = &precise.begun(world.id);
  return begun;
}

}  // namespace pbmpi::estimate
