/// Helpers of the tests of the frame loop.
#pragma once

#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "mpi/worlds/world_driver.h"
#include "synthetic_stepper.h"

namespace pbmpi::testing_support {

using mpi::Communicator;
using mpi::WorldDriver;
using mpi::WorldRunResult;
using mpi::WorldRunSettings;

inline constexpr double never = std::numeric_limits<double>::infinity();

inline WorldRunSettings settings_of(int num_worlds, double rebalance_threshold = never) {
  WorldRunSettings settings;
  settings.num_worlds = num_worlds;
  settings.warmup = 2;
  settings.frames = 10;
  settings.rebalance_threshold = rebalance_threshold;
  return settings;
}

inline WorldRunResult run(const Communicator& comm, const WorldRunSettings& settings,
                          SyntheticStepper::Behaviour behaviour = {}) {
  SyntheticStepper stepper(std::move(behaviour));
  WorldDriver driver(comm, stepper, synthetic_model, settings);
  return driver.run();
}

/// Hash of a run with these settings on one rank without MPI.
inline std::uint64_t reference_hash(const WorldRunSettings& settings) {
  WorldRunSettings alone = settings;
  alone.placement.clear();
  return run(Communicator(), alone).state_hash;
}

/// Records what an observer gets.
class Recorder : public stepping::FrameObserver {
 public:
  struct Frame {
    std::int64_t frame, step;
    double time_s;
    bool measured;
    std::vector<int> worlds;
    double wall_s;
    bool deadline_met;
    core::PhaseTimes phases;
  };

  void frame_done(const stepping::FrameRecord& frame) override {
    std::vector<int> ids;
    for (const stepping::LocalWorld& world : frame.worlds) ids.push_back(world.id);
    frames.push_back({frame.frame, frame.step, frame.time_s, frame.measured, ids, frame.wall_s,
                      frame.deadline_met, frame.phases});
  }
  void event(const stepping::RunEvent& event) override { events.push_back(event); }

  std::vector<Frame> frames;
  std::vector<stepping::RunEvent> events;
};

}  // namespace pbmpi::testing_support
