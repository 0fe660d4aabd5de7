#include "mpi/worlds/world_driver.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <span>
#include <vector>

#include "../world_driver_support.h"
#include "core/hash.h"

namespace pbmpi::mpi {
namespace {

using testing_support::never;
using testing_support::Recorder;
using testing_support::reference_hash;
using testing_support::run;
using testing_support::settings_of;
using testing_support::synthetic_model;
using testing_support::SyntheticStepper;

/// Costs that make the worlds of the first rank three times as expensive as the others.
SyntheticStepper::Behaviour dear_first_quarter(int num_worlds) {
  SyntheticStepper::Behaviour behaviour;
  behaviour.cost_s = [num_worlds](int world) { return world < num_worlds / 4 ? 3e-3 : 1e-3; };
  return behaviour;
}

TEST(WorldDriver, gives_the_same_hash_for_any_number_of_ranks_and_any_placement) {
  const Communicator comm = Communicator::world();
  WorldRunSettings settings = settings_of(13);
  const std::uint64_t expected = reference_hash(settings);
  EXPECT_EQ(run(comm, settings).state_hash, expected);
  for (int shift = 0; shift < comm.size(); ++shift) {
    settings.placement.resize(13);
    for (int world = 0; world < 13; ++world) settings.placement[world] = (5 * world + shift) % comm.size();
    EXPECT_EQ(run(comm, settings).state_hash, expected);
  }
  settings.placement.assign(13, comm.size() - 1);  // everything on the last rank
  EXPECT_EQ(run(comm, settings).state_hash, expected);
}

TEST(WorldDriver, hash_depends_on_every_world_and_their_order) {
  const std::vector<std::uint64_t> hashes = {1, 2, 3};
  const std::uint64_t combined = combine_world_hashes(hashes);
  EXPECT_NE(combined, combine_world_hashes(std::vector<std::uint64_t>{2, 1, 3}));
  EXPECT_NE(combined, combine_world_hashes(std::vector<std::uint64_t>{1, 2}));
  EXPECT_NE(combined, combine_world_hashes(std::vector<std::uint64_t>{1, 2, 4}));
  core::Hash64 by_hand;
  for (const std::uint64_t hash : hashes) by_hand.add(hash);
  EXPECT_EQ(combined, by_hand.value());
}

TEST(WorldDriver, hash_is_that_of_the_final_states) {
  const Communicator comm = Communicator::world();
  SyntheticStepper stepper;
  WorldDriver driver(comm, stepper, synthetic_model, settings_of(6));
  const WorldRunResult result = driver.run();

  SyntheticStepper alone;
  const OwnedWorlds all(Communicator(), alone, synthetic_model, Placement(6, 0));
  core::PhaseTimes times;
  alone.advance(12 * 3, times);
  std::vector<std::uint64_t> hashes;
  for (int world = 0; world < 6; ++world) hashes.push_back(model::hash(alone.state(world)));
  EXPECT_EQ(result.state_hash, combine_world_hashes(hashes));
}

TEST(WorldDriver, moves_worlds_when_costs_are_unequal_and_keeps_every_bit) {
  const Communicator comm = Communicator::world();
  constexpr int num_worlds = 40;
  const WorldRunSettings settings = settings_of(num_worlds, 1.1);
  const SyntheticStepper::Behaviour behaviour = dear_first_quarter(num_worlds);
  SyntheticStepper stepper(behaviour);
  WorldDriver driver(comm, stepper, synthetic_model, settings);
  Recorder recorder;
  driver.add_observer(recorder);
  const WorldRunResult result = driver.run();
  EXPECT_EQ(result.state_hash, reference_hash(settings));
  if (comm.size() == 1) {
    EXPECT_EQ(result.num_rebalances, 0);
    return;
  }
  EXPECT_EQ(result.num_rebalances, 1);  // the costs do not change, so one is enough
  EXPECT_GT(result.worlds_moved, 0);
  std::vector<double> cost(num_worlds);
  for (int world = 0; world < num_worlds; ++world) cost[world] = behaviour.cost_s(world);
  EXPECT_GT(imbalance(rank_loads(equal_placement(num_worlds, comm.size()), cost, comm.size())), 1.1);
  EXPECT_LT(imbalance(rank_loads(driver.placement(), cost, comm.size())), 1.1);
  EXPECT_EQ(stepper.num_worlds(), std::ssize(driver.local_worlds()));

  ASSERT_EQ(recorder.events.size(), 1u);
  EXPECT_EQ(recorder.events[0].kind, "rebalance");
  EXPECT_EQ(recorder.events[0].frame, 1);
  EXPECT_NE(recorder.events[0].detail.find("max/avg useful time"), std::string::npos);
}

TEST(WorldDriver, gets_the_costs_from_the_owners) {
  const Communicator comm = Communicator::world();
  if (comm.size() == 1) GTEST_SKIP() << "needs two ranks";
  // A rank knows only the costs of worlds that it stepped itself: asked for another's, at() throws.
  SyntheticStepper::Behaviour behaviour;
  std::map<int, double> stepped;
  behaviour.before_step = [&](int world, std::int64_t) { stepped[world] = 1e-6 * (world + 1); };
  behaviour.cost_s = [&](int world) { return stepped.at(world); };
  const WorldRunResult result = run(comm, settings_of(24, 1.1), behaviour);
  EXPECT_EQ(result.num_rebalances, 1);
  EXPECT_EQ(result.state_hash, reference_hash(settings_of(24)));
}

TEST(WorldDriver, moves_nothing_when_costs_are_equal) {
  const WorldRunResult result = run(Communicator::world(), settings_of(24, 1.1));
  EXPECT_EQ(result.num_rebalances, 0);
  EXPECT_EQ(result.worlds_moved, 0);
}

TEST(WorldDriver, moves_nothing_with_an_infinite_threshold) {
  EXPECT_EQ(run(Communicator::world(), settings_of(24, never), dear_first_quarter(24)).num_rebalances, 0);
}

TEST(WorldDriver, shows_every_frame_once_to_observers_on_every_rank) {
  const Communicator comm = Communicator::world();
  SyntheticStepper stepper;
  WorldRunSettings settings = settings_of(7);
  settings.budget_s = 1e9;
  WorldDriver driver(comm, stepper, synthetic_model, settings);
  Recorder first, second;
  driver.add_observer(first);
  driver.add_observer(second);
  const WorldRunResult result = driver.run();
  EXPECT_EQ(result.frames_done, 12);
  ASSERT_EQ(result.times.size(), 12u);
  ASSERT_EQ(first.frames.size(), 12u);
  EXPECT_EQ(second.frames.size(), 12u);
  EXPECT_TRUE(first.events.empty());
  for (int k = 0; k < 12; ++k) {
    const Recorder::Frame& frame = first.frames[k];
    EXPECT_EQ(frame.frame, k);
    EXPECT_EQ(frame.step, 3 * (k + 1));
    EXPECT_DOUBLE_EQ(frame.time_s, 0.03 * (k + 1));
    EXPECT_EQ(frame.measured, k >= 2);
    EXPECT_TRUE(frame.deadline_met);
    EXPECT_EQ(frame.wall_s, result.times[k].wall_s);
    EXPECT_EQ(frame.measured, result.times[k].measured);
    EXPECT_EQ(frame.phases.seconds, result.times[k].phases.seconds);
    // Root's wall time reaches every rank.
    for (const double wall_s : comm.allgather(frame.wall_s)) EXPECT_EQ(wall_s, frame.wall_s);
    EXPECT_GT(frame.wall_s, 0);
    // The ranks' worlds together contain each world once.
    std::vector<int> worlds = comm.allgatherv(std::span<const int>(frame.worlds));
    EXPECT_TRUE(std::is_sorted(frame.worlds.begin(), frame.worlds.end()));
    std::sort(worlds.begin(), worlds.end());
    EXPECT_EQ(worlds, (std::vector<int>{0, 1, 2, 3, 4, 5, 6}));
  }
}

TEST(WorldDriver, books_the_phases_of_a_frame_and_the_output_of_the_frame_before) {
  const Communicator comm = Communicator::world();
  SyntheticStepper stepper;
  WorldDriver driver(comm, stepper, synthetic_model, settings_of(8));
  Recorder recorder;
  driver.add_observer(recorder);
  driver.run();
  for (std::size_t k = 0; k < recorder.frames.size(); ++k) {
    const core::PhaseTimes& phases = recorder.frames[k].phases;
    EXPECT_EQ(phases[core::Phase::output] > 0, k > 0);
    EXPECT_GT(phases[core::Phase::solve], 0);
    EXPECT_GT(phases[core::Phase::gather], 0);
    EXPECT_GT(phases[core::Phase::wait], 0);
    if (!comm.is_root()) continue;
    // Parts of the frame, read from the same clock: they fit without a tolerance.
    EXPECT_LE(phases[core::Phase::solve] + phases[core::Phase::gather], recorder.frames[k].wall_s);
  }
}

TEST(WorldDriver, misses_a_deadline_that_nothing_can_meet) {
  SyntheticStepper stepper;
  WorldRunSettings settings = settings_of(3);
  settings.budget_s = 0;
  WorldDriver driver(Communicator::world(), stepper, synthetic_model, settings);
  Recorder recorder;
  driver.add_observer(recorder);
  driver.run();
  for (const Recorder::Frame& frame : recorder.frames) EXPECT_FALSE(frame.deadline_met);
}

/// Compares all poses of each frame with those of a run in one place.
class PoseChecker : public stepping::PoseConsumer {
 public:
  void poses(std::int64_t frame, stepping::PoseKind kind, std::span<const model::Vec3> position,
             std::span<const model::Quat> orientation) override {
    EXPECT_EQ(kind, stepping::PoseKind::precise);
    EXPECT_EQ(frame, frames++);
    core::PhaseTimes times;
    reference.advance(3, times);
    std::size_t row = 0;
    for (int world = 0; world < reference.num_worlds(); ++world) {
      const model::State& state = reference.state(world);
      for (int body = 0; body < state.num_bodies(); ++body, ++row) {
        EXPECT_EQ(position[row], state.position[body]);
        EXPECT_EQ(orientation[row], state.orientation[body]);
      }
    }
    EXPECT_EQ(row, position.size());
    EXPECT_EQ(row, orientation.size());
  }

  SyntheticStepper reference;
  std::int64_t frames = 0;
};

TEST(WorldDriver, gives_consumers_on_root_all_poses_in_order_also_after_a_rebalance) {
  const Communicator comm = Communicator::world();
  SyntheticStepper stepper(dear_first_quarter(16));
  WorldDriver driver(comm, stepper, synthetic_model, settings_of(16, 1.1));
  PoseChecker checker;
  const OwnedWorlds all(Communicator(), checker.reference, synthetic_model, Placement(16, 0));
  driver.add_consumer(checker);
  const WorldRunResult result = driver.run();
  EXPECT_EQ(result.num_rebalances > 0, comm.size() > 1);
  EXPECT_EQ(checker.frames, comm.is_root() ? 12 : 0);
}

TEST(WorldDriver, runs_with_more_ranks_than_worlds) {
  const Communicator comm = Communicator::world();
  SyntheticStepper stepper;
  WorldDriver driver(comm, stepper, synthetic_model, settings_of(1, 1.1));
  Recorder recorder;
  driver.add_observer(recorder);
  const WorldRunResult result = driver.run();
  EXPECT_EQ(recorder.frames.size(), 12u);
  EXPECT_EQ(driver.local_worlds().size(), comm.is_root() ? 1u : 0u);
  EXPECT_EQ(result.num_rebalances, 0);
  EXPECT_EQ(result.state_hash, reference_hash(settings_of(1)));
}

}  // namespace
}  // namespace pbmpi::mpi
