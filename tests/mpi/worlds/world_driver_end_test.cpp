/// How a run ends before its last frame: stop, error, non-finite state, refused settings.

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <string>

#include "../world_driver_support.h"
#include "core/error.h"
#include "mpi/worlds/world_driver.h"

namespace pbmpi::mpi {
namespace {

using testing_support::Recorder;
using testing_support::run;
using testing_support::settings_of;
using testing_support::synthetic_model;
using testing_support::SyntheticStepper;

/// Throws from a given frame on, on one rank.
class FailingObserver : public stepping::FrameObserver {
 public:
  FailingObserver(std::int64_t frame, bool here) : frame_(frame), here_(here) {}
  void frame_done(const stepping::FrameRecord& frame) override {
    if (here_ && frame.frame == frame_) throw core::RunError("disk full");
  }

 private:
  std::int64_t frame_;
  bool here_;
};

template <class Error, class Function>
std::string message_of(Function&& function) {
  try {
    function();
  } catch (const Error& error) {
    return error.what();
  }
  ADD_FAILURE() << "no error";
  return "";
}

std::string named(const Communicator& comm, int rank, const std::string& message) {
  return comm.size() > 1 ? "rank " + std::to_string(rank) + ": " + message : message;
}

TEST(WorldDriver, stops_all_ranks_after_the_same_frame_when_one_is_asked_to) {
  const Communicator comm = Communicator::world();
  std::atomic<int> stop{0};
  SyntheticStepper::Behaviour behaviour;
  // A signal that only the owner of world 4 receives, in frame 5 (steps 15 to 17).
  behaviour.before_step = [&](int world, std::int64_t step) {
    if (world == 4 && step == 16) stop = 15;
  };
  SyntheticStepper stepper(behaviour);
  WorldDriver driver(comm, stepper, synthetic_model, settings_of(5));
  Recorder recorder;
  driver.add_observer(recorder);
  driver.set_stop_flag(stop);
  const WorldRunResult result = driver.run();
  EXPECT_TRUE(result.stopped);
  EXPECT_EQ(result.frames_done, 6);
  EXPECT_TRUE(result.failure.empty());
  EXPECT_EQ(recorder.frames.size(), 6u);
  ASSERT_EQ(recorder.events.size(), 1u);
  EXPECT_EQ(recorder.events[0].kind, "signal");
  EXPECT_EQ(recorder.events[0].frame, 5);
  EXPECT_EQ(recorder.events[0].detail, "stop requested (signal 15)");
}

TEST(WorldDriver, is_done_and_not_stopped_when_asked_in_the_last_frame) {
  std::atomic<int> stop{0};
  SyntheticStepper::Behaviour behaviour;
  behaviour.before_step = [&](int, std::int64_t step) {
    if (step == 35) stop = 2;
  };
  SyntheticStepper stepper(behaviour);
  WorldDriver driver(Communicator::world(), stepper, synthetic_model, settings_of(4));
  driver.set_stop_flag(stop);
  const WorldRunResult result = driver.run();
  EXPECT_FALSE(result.stopped);
  EXPECT_EQ(result.frames_done, 12);
}

TEST(WorldDriver, throws_on_every_rank_what_the_stepper_throws_on_one) {
  const Communicator comm = Communicator::world();
  const int last = comm.size() - 1;
  SyntheticStepper::Behaviour behaviour;
  behaviour.before_step = [&](int world, std::int64_t step) {
    if (world == 7 && step == 10) throw core::RunError("world 7: the solver gave up");
  };
  const std::string message = message_of<core::RunError>([&] { run(comm, settings_of(8), behaviour); });
  EXPECT_EQ(message, named(comm, last, "world 7: the solver gave up"));
}

TEST(WorldDriver, throws_on_every_rank_what_an_observer_throws_on_one_in_any_frame) {
  const Communicator comm = Communicator::world();
  const int culprit = comm.size() - 1;
  for (const std::int64_t frame : {0, 5, 11}) {  // 11 is the last frame: only the end of the run follows
    SyntheticStepper stepper;
    WorldDriver driver(comm, stepper, synthetic_model, settings_of(8));
    FailingObserver failing(frame, comm.rank() == culprit);
    Recorder after;
    driver.add_observer(failing);
    driver.add_observer(after);
    EXPECT_EQ(message_of<core::RunError>([&] { driver.run(); }), named(comm, culprit, "disk full"));
    EXPECT_EQ(std::ssize(after.frames), frame + 1);  // observers after the failing one were not skipped
  }
}

TEST(WorldDriver, keeps_an_observers_message_plain_when_it_fails_everywhere) {
  SyntheticStepper stepper;
  WorldDriver driver(Communicator::world(), stepper, synthetic_model, settings_of(8));
  FailingObserver failing(3, true);
  driver.add_observer(failing);
  EXPECT_EQ(message_of<core::RunError>([&] { driver.run(); }), "disk full");
}

TEST(WorldDriver, ends_the_run_after_the_frame_in_which_a_body_becomes_nonfinite) {
  const Communicator comm = Communicator::world();
  SyntheticStepper::Behaviour behaviour;
  behaviour.turns_nan = [](int world, std::int64_t step) { return world >= 5 && step == 13; };
  SyntheticStepper stepper(behaviour);
  WorldDriver driver(comm, stepper, synthetic_model, settings_of(8));
  Recorder recorder;
  driver.add_observer(recorder);
  const WorldRunResult result = driver.run();
  EXPECT_EQ(result.failure, "world 5 has 1 non-finite body in frame 4");
  EXPECT_EQ(result.frames_done, 5);
  EXPECT_EQ(recorder.frames.size(), 5u);  // observers saw the frame
  EXPECT_FALSE(result.stopped);
}

TEST(WorldDriver, refuses_settings_that_make_no_sense) {
  const Communicator comm = Communicator::world();
  const auto refuses = [&](auto change) {
    WorldRunSettings settings = settings_of(4);
    change(settings);
    EXPECT_THROW(run(comm, settings), core::InputError);
  };
  refuses([](WorldRunSettings& s) { s.num_worlds = 0; });
  refuses([](WorldRunSettings& s) { s.warmup = -1; });
  refuses([](WorldRunSettings& s) { s.frames = 0; });
  refuses([](WorldRunSettings& s) { s.steps_per_frame = 0; });
  refuses([](WorldRunSettings& s) { s.dt_s = -0.01; });
  refuses([](WorldRunSettings& s) { s.dt_s = std::nan(""); });
  refuses([](WorldRunSettings& s) { s.rebalance_threshold = 0.5; });
  refuses([](WorldRunSettings& s) { s.rebalance_threshold = std::nan(""); });
  refuses([](WorldRunSettings& s) { s.placement = {0, 0}; });
  refuses([&](WorldRunSettings& s) { s.placement = {0, 0, 0, comm.size()}; });
}

TEST(WorldDriver, refuses_settings_that_differ_between_ranks) {
  const Communicator comm = Communicator::world();
  if (comm.size() == 1) GTEST_SKIP() << "needs two ranks";
  WorldRunSettings settings = settings_of(4);
  settings.frames += comm.rank();
  EXPECT_THROW(run(comm, settings), std::logic_error);
}

}  // namespace
}  // namespace pbmpi::mpi
