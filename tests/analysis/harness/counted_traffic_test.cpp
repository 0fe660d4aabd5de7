#include <gtest/gtest.h>

#include "analysis/harness/frame_traffic.h"
#include "mpi/worlds/world_driver.h"
#include "synthetic/fixed_cost_stepper.h"

namespace pbmpi::analysis {
namespace {

/// Sums FrameRecord::traffic over all ranks and frames.
class TrafficCount final : public stepping::FrameObserver {
 public:
  void frame_done(const stepping::FrameRecord& frame) override {
    sum.messages += frame.traffic.messages;
    sum.bytes += frame.traffic.bytes;
  }
  core::Traffic sum;
};

// The traffic does not depend on the clock, so it is exact.
TEST(FrameTraffic, is_what_the_ranks_count) {
  const mpi::Communicator comm = mpi::Communicator::world();
  constexpr int bodies = 5, frames = 4;
  for (const int num_worlds : {3, 64, 1000}) {
    synthetic::FixedCostStepper stepper(0);
    const auto model = synthetic::make_model(bodies);
    mpi::WorldRunSettings settings;
    settings.num_worlds = num_worlds;
    settings.warmup = 0;
    settings.frames = frames;
    mpi::WorldDriver driver(
        comm, stepper, [&](int) { return model; }, settings);
    TrafficCount count;
    driver.add_observer(count);
    driver.run();
    std::array<std::int64_t, 2> sums = {count.sum.messages, count.sum.bytes};
    comm.allreduce(sums, mpi::Reduce::sum);
    const FrameTraffic forecast =
        frame_traffic({.num_ranks = comm.size(), .num_worlds = num_worlds, .bodies_each = bodies});
    EXPECT_EQ(sums[0], frames * forecast.gather.messages) << num_worlds << " worlds";
    EXPECT_EQ(sums[1], frames * forecast.gather.bytes) << num_worlds << " worlds";
  }
}

TEST(FrameTraffic, comes_with_one_hash_for_any_number_of_ranks) {
  const auto hash_of = [](const mpi::Communicator& comm) {
    synthetic::FixedCostStepper stepper(0);
    const auto model = synthetic::make_model(3);
    mpi::WorldRunSettings settings;
    settings.num_worlds = 50;
    return mpi::WorldDriver(
               comm, stepper, [&](int) { return model; }, settings)
        .run()
        .state_hash;
  };
  EXPECT_EQ(hash_of(mpi::Communicator::world()), hash_of(mpi::Communicator()));
}

}  // namespace
}  // namespace pbmpi::analysis
