// Worlds that blow up, on ranks between which they move.
#include <gtest/gtest.h>

#include "../world_driver_support.h"
#include "mpi/worlds/world_driver.h"
#include "ode/collide/narrow_phase.h"
#include "ode/ode_stepper.h"
#include "solver/worlds/sor_stepper.h"
#include "stability/guarded_stepper.h"
#include "stepping/stepper_traits.h"
#include "support/hard_models.h"
#include "support/models.h"

namespace pbmpi::mpi {
namespace {

namespace event_kind = stepping::event_kind;
using stability::GuardedStepper;
using stability::OnBlowup;
using testing_support::never;
using testing_support::Recorder;
using testing_support::settings_of;

constexpr int num_worlds = 8;

std::shared_ptr<const model::Model> build(int world) {
  if (world % 4 == 1) return std::make_shared<const model::Model>(support::overlapping_cubes(0.3 * world));
  if (world % 4 == 2) return std::make_shared<const model::Model>(support::loaded_chain(10 + world, 100));
  return std::make_shared<const model::Model>(support::crash(world));
}

std::unique_ptr<stepping::WorldStepper> make_stepper(const stepping::StepperSettings& settings) {
  if (settings.kind == stepping::StepperKind::sor)
    return solver::make_sor_stepper(settings, ode::make_narrow_phase);
  return ode::make_ode_stepper(settings, [](const std::string&) {});
}

struct GuardedRun {
  WorldRunResult result;
  std::vector<stepping::RunEvent> events;

  std::int64_t count(const char* kind) const {
    return std::ranges::count(events, kind, &stepping::RunEvent::kind);
  }
};

GuardedRun run(const Communicator& comm, WorldRunSettings settings, stepping::StepperKind kind,
               OnBlowup on_blowup) {
  const stepping::StepperSettings stepper_settings = default_settings(kind, stepping::Law::ode);
  settings.frames = 30;
  settings.stop_at_blowup = on_blowup == OnBlowup::stop;
  GuardedStepper stepper(make_stepper(stepper_settings), {on_blowup, stepper_settings, make_stepper, {}});
  WorldDriver driver(comm, stepper, build, settings);
  driver.set_event_source(stepper);
  Recorder recorder;
  driver.add_observer(recorder);
  WorldRunResult result = driver.run();
  return {std::move(result), std::move(recorder.events)};
}

class EveryChoice : public testing::TestWithParam<std::pair<stepping::StepperKind, OnBlowup>> {};
INSTANTIATE_TEST_SUITE_P(SteppersAndActions, EveryChoice,
                         testing::Values(std::pair(stepping::StepperKind::sor, OnBlowup::report),
                                         std::pair(stepping::StepperKind::sor, OnBlowup::freeze),
                                         std::pair(stepping::StepperKind::sor, OnBlowup::refine),
                                         std::pair(stepping::StepperKind::quick, OnBlowup::freeze),
                                         std::pair(stepping::StepperKind::quick, OnBlowup::refine)));

TEST_P(EveryChoice, has_the_same_bits_and_events_on_any_number_of_ranks) {
  const auto [kind, on_blowup] = GetParam();
  const GuardedRun alone = run(Communicator(), settings_of(num_worlds), kind, on_blowup);
  EXPECT_EQ(alone.result.failure, "");
  if (on_blowup == OnBlowup::freeze) {
    EXPECT_GT(alone.count(event_kind::frozen), 0);
  }
  if (on_blowup == OnBlowup::refine) {
    EXPECT_GT(alone.count(event_kind::refined), 0);
  }
  for (const double threshold : {never, 1.0}) {
    const GuardedRun found = run(Communicator::world(), settings_of(num_worlds, threshold), kind, on_blowup);
    EXPECT_EQ(found.result.state_hash, alone.result.state_hash);
    std::vector<std::string> details, expected;
    for (const auto& event : found.events) {
      if (event.kind != event_kind::rebalance) details.push_back(event.detail);
    }
    for (const auto& event : alone.events) expected.push_back(event.detail);
    EXPECT_EQ(details, expected);
  }
}

TEST(GuardedWorlds, end_the_run_with_stop_on_every_rank) {
  const GuardedRun found =
      run(Communicator::world(), settings_of(num_worlds), stepping::StepperKind::sor, OnBlowup::stop);
  EXPECT_LT(found.result.frames_done, 32);
  ASSERT_FALSE(found.events.empty());
  EXPECT_EQ(found.result.failure, found.events[0].detail +
                                      "; the run ends here (--on-blowup stop), after frame " +
                                      std::to_string(found.result.frames_done - 1));
}

}  // namespace
}  // namespace pbmpi::mpi
