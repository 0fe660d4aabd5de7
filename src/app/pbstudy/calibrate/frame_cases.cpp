#include <algorithm>
#include <limits>

#include "app/pbstudy/calibrate/calibrate_cases.h"
#include "mpi/worlds/world_driver.h"
#include "synthetic/fixed_cost_stepper.h"

namespace pbmpi::app {

double time_frame(const mpi::Communicator& comm, const TimedCase& one) {
  synthetic::FixedCostStepper stepper(0);
  auto model = synthetic::make_model(static_cast<int>(one.bodies));
  mpi::WorldRunSettings settings;
  settings.num_worlds = static_cast<int>(one.worlds);
  settings.warmup = 3;
  settings.frames = 20;
  settings.steps_per_frame = static_cast<int>(one.steps);
  settings.rebalance_threshold = std::numeric_limits<double>::infinity();
  mpi::WorldDriver driver(
      comm, stepper, [&](int) { return model; }, settings);
  const mpi::WorldRunResult result = driver.run();
  // Disturbances only add time, and the frames are alike.
  double shortest_s = std::numeric_limits<double>::infinity();
  for (const mpi::FrameTimes& times : result.times) {
    if (times.measured) shortest_s = std::min(shortest_s, times.wall_s);
  }
  return shortest_s;
}

}  // namespace pbmpi::app
