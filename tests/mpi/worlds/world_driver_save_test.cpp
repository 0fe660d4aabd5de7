/// Snapshots of a run between its frames, and runs that are resumed from one.

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <string>

#include "../world_driver_support.h"
#include "core/error.h"
#include "mpi/worlds/world_driver.h"

namespace pbmpi::mpi {
namespace {

using testing_support::Recorder;
using testing_support::settings_of;
using testing_support::synthetic_model;
using testing_support::SyntheticStepper;

constexpr int num_worlds = 7;

SyntheticStepper resting_stepper() {
  SyntheticStepper::Behaviour behaviour;
  behaviour.rests = true;
  return SyntheticStepper(behaviour);
}

class Shelf : public SnapshotKeeper {
 public:
  std::string keep(Snapshot snapshot) override {
    snapshots.push_back(std::move(snapshot));
    if (full) throw core::RunError("disk full");
    return "kept";
  }
  bool full = false;
  std::vector<Snapshot> snapshots;
};

/// Requests a snapshot on this rank in one frame.
class Asker : public stepping::FrameObserver {
 public:
  Asker(std::atomic<int>& requests, std::int64_t frame) : requests_(&requests), frame_(frame) {}
  void frame_done(const stepping::FrameRecord& frame) override {
    if (frame.frame == frame_) ++*requests_;
  }

 private:
  std::atomic<int>* requests_;
  std::int64_t frame_;
};

/// Records the number of snapshots at each call of secure().
class Holder : public stepping::FrameObserver {
 public:
  explicit Holder(const Shelf& shelf) : shelf_(&shelf) {}
  void frame_done(const stepping::FrameRecord&) override {}
  void secure() override { snapshots_before.push_back(shelf_->snapshots.size()); }
  std::vector<std::size_t> snapshots_before;

 private:
  const Shelf* shelf_;
};

std::int64_t num_events(const Recorder& recorder, const std::string& kind) {
  return std::count_if(recorder.events.begin(), recorder.events.end(),
                       [&](const stepping::RunEvent& event) { return event.kind == kind; });
}

TEST(Snapshot, is_made_once_for_a_request_that_ranks_see_in_different_frames) {
  const Communicator comm = Communicator::world();
  SyntheticStepper stepper = resting_stepper();
  WorldDriver driver(comm, stepper, synthetic_model, settings_of(num_worlds));
  std::atomic<int> requests{0};
  Asker asker(requests, 2 + comm.rank());
  Recorder recorder;
  Shelf shelf;
  CheckpointPlan plan;
  plan.requests = &requests;
  driver.save_to(shelf, plan);
  driver.add_observer(asker);
  driver.add_observer(recorder);
  const WorldRunResult result = driver.run();
  EXPECT_FALSE(result.stopped);
  EXPECT_EQ(num_events(recorder, "checkpoint"), 1);
  EXPECT_EQ(std::ssize(shelf.snapshots), comm.is_root() ? 1 : 0) << "root keeps them";
  if (!comm.is_root()) return;
  EXPECT_EQ(shelf.snapshots[0].frames, 4) << "asked for in frame 2, and so agreed on in frame 3";
  EXPECT_EQ(shelf.snapshots[0].steps, 4 * 3);
  EXPECT_FALSE(shelf.snapshots[0].ends_run);
}

TEST(Snapshot, lets_a_run_go_on_with_other_owners_to_the_same_bits) {
  const Communicator comm = Communicator::world();
  SyntheticStepper whole_stepper = resting_stepper(), stepper = resting_stepper();
  WorldDriver whole(comm, whole_stepper, synthetic_model, settings_of(num_worlds));
  std::atomic<int> requests{0};
  Asker asker(requests, 4);
  Shelf shelf;
  CheckpointPlan plan;
  plan.requests = &requests;
  whole.save_to(shelf, plan);
  whole.add_observer(asker);
  const WorldRunResult expected = whole.run();

  WorldRunSettings settings = settings_of(num_worlds);
  settings.first_frame = 6;
  settings.placement.assign(num_worlds, comm.size() - 1);
  settings.placement[3] = 0;
  std::vector<model::State> states;
  if (comm.is_root()) states = shelf.snapshots.at(0).worlds;
  WorldDriver rest(comm, stepper, synthetic_model, settings, states);
  Recorder recorder;
  rest.add_observer(recorder);
  const WorldRunResult result = rest.run();
  EXPECT_EQ(result.state_hash, expected.state_hash);
  EXPECT_EQ(result.frames_done, expected.frames_done);
  EXPECT_EQ(recorder.frames.front().frame, 6) << "frames keep their numbers";
  EXPECT_EQ(result.times.size(), expected.times.size() - 6);
}

TEST(Snapshot, that_cannot_be_kept_does_not_end_the_run) {
  const Communicator comm = Communicator::world();
  SyntheticStepper stepper = resting_stepper();
  WorldDriver driver(comm, stepper, synthetic_model, settings_of(num_worlds));
  Recorder recorder;
  Shelf shelf;
  shelf.full = true;
  CheckpointPlan plan;
  plan.every_s = 0;
  plan.at_end = true;
  driver.save_to(shelf, plan);
  driver.add_observer(recorder);
  const WorldRunResult result = driver.run();
  EXPECT_EQ(num_events(recorder, "checkpoint"), result.frames_done);
  EXPECT_EQ(recorder.events.back().detail, "failed: disk full");
  EXPECT_EQ(result.save_failure, "disk full") << "every rank knows that the end was not kept";
}

TEST(Snapshot, is_made_when_observers_have_written_what_they_hold) {
  const Communicator comm = Communicator::world();
  SyntheticStepper stepper = resting_stepper();
  WorldDriver driver(comm, stepper, synthetic_model, settings_of(num_worlds));
  Shelf shelf;
  Holder holder(shelf);
  CheckpointPlan plan;
  plan.every_s = 0;
  driver.save_to(shelf, plan);
  driver.add_observer(holder);
  const WorldRunResult result = driver.run();
  ASSERT_EQ(std::ssize(holder.snapshots_before), result.frames_done) << "on every rank";
  if (!comm.is_root()) return;
  for (std::size_t i = 0; i < holder.snapshots_before.size(); ++i) EXPECT_EQ(holder.snapshots_before[i], i);
}

TEST(Snapshot, is_made_of_a_run_whose_time_is_up_and_not_of_one_that_failed) {
  const Communicator comm = Communicator::world();
  for (const bool fails : {false, true}) {
    SyntheticStepper::Behaviour behaviour;
    behaviour.turns_nan = [&](int world, std::int64_t step) { return fails && world == 2 && step == 1; };
    SyntheticStepper stepper(behaviour);
    WorldDriver driver(comm, stepper, synthetic_model, settings_of(num_worlds));
    Recorder recorder;
    Shelf shelf;
    driver.save_to(shelf, {});
    driver.set_time_limit(0);
    driver.add_observer(recorder);
    const WorldRunResult result = driver.run();
    EXPECT_TRUE(result.stopped);
    EXPECT_EQ(result.frames_done, 1);
    EXPECT_EQ(result.failure.empty(), !fails);
    EXPECT_EQ(num_events(recorder, "time_limit"), 1);
    EXPECT_EQ(num_events(recorder, "checkpoint"), fails ? 0 : 1);
    ASSERT_EQ(shelf.snapshots.size(), comm.is_root() && !fails ? 1u : 0u);
    for (const Snapshot& snapshot : shelf.snapshots) EXPECT_TRUE(snapshot.ends_run);
  }
}

TEST(Snapshot, with_too_few_worlds_is_refused_on_every_rank) {
  const Communicator comm = Communicator::world();
  SyntheticStepper stepper = resting_stepper();
  WorldRunSettings settings = settings_of(num_worlds);
  settings.first_frame = 2;
  const std::vector<model::State> states(num_worlds - 1);
  EXPECT_THROW(WorldDriver(comm, stepper, synthetic_model, settings, states), core::RunError);
  settings.first_frame = settings.warmup + settings.frames;
  EXPECT_THROW(WorldDriver(comm, stepper, synthetic_model, settings, states), core::InputError);
}

}  // namespace
}  // namespace pbmpi::mpi
