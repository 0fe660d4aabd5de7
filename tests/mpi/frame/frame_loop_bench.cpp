/// Cost of the frame loop itself: the worlds' steps cost next to nothing, so that agreement, gather and
/// bookkeeping remain. Prints the seconds of a frame (median and p99 of root), per rank count of the launch:
///   mpirun -n 2 frame_loop_bench [worlds] [frames]

#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "../synthetic_stepper.h"
#include "core/statistics.h"
#include "mpi/comm/session.h"
#include "mpi/worlds/world_driver.h"

namespace {

using pbmpi::core::Phase;

double median_us(const std::vector<double>& seconds) { return 1e6 * pbmpi::core::quantile(seconds, 0.5); }

void measure(const pbmpi::mpi::Communicator& comm, int num_worlds, int num_frames) {
  pbmpi::testing_support::SyntheticStepper stepper;
  pbmpi::mpi::WorldRunSettings settings;
  settings.num_worlds = num_worlds;
  settings.warmup = 100;
  settings.frames = num_frames;
  settings.steps_per_frame = 1;
  pbmpi::mpi::WorldDriver driver(comm, stepper, pbmpi::testing_support::synthetic_model, settings);
  const pbmpi::mpi::WorldRunResult result = driver.run();
  if (!comm.is_root()) return;
  std::vector<double> loop, gather, wait;
  for (const pbmpi::mpi::FrameTimes& frame : result.times) {
    if (!frame.measured) continue;
    loop.push_back(frame.wall_s - frame.phases.useful_s());
    gather.push_back(frame.phases[Phase::gather]);
    wait.push_back(frame.phases[Phase::wait]);
  }
  std::printf(
      "ranks %d worlds %d bodies %lld frames %d: loop without steps %.2f us median, %.2f us p99 "
      "(gather %.2f, wait %.2f median), state_hash %016llx\n",
      comm.size(), num_worlds, static_cast<long long>(driver.table().num_bodies()), num_frames,
      median_us(loop), 1e6 * pbmpi::core::quantile(loop, 0.99), median_us(gather), median_us(wait),
      static_cast<unsigned long long>(result.state_hash));
}

}  // namespace

int main(int argc, char** argv) {
  const pbmpi::mpi::Session session(argc, argv);
  const int num_worlds = argc > 1 ? std::atoi(argv[1]) : 100;
  const int num_frames = argc > 2 ? std::atoi(argv[2]) : 20000;
  measure(pbmpi::mpi::Communicator::world(), num_worlds, num_frames);
  return 0;
}
