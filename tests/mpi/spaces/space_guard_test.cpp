// Guards of a world that is cut into spaces.
#include <gtest/gtest.h>

#include "../world_driver_support.h"
#include "ode/collide/narrow_phase.h"
#include "solver/worlds/sor_stepper.h"
#include "space_run.h"
#include "stability/guarded_stepper.h"
#include "stepping/stepper_traits.h"
#include "support/models.h"

namespace pbmpi::mpi {
namespace {

namespace event_kind = stepping::event_kind;
using stability::OnBlowup;
using testing_support::placements_of_four_spaces;
using testing_support::Recorder;
using testing_support::share;
using testing_support::SharedModel;
using testing_support::space_settings;
using testing_support::world;

/// neighbours() in which a launch puts a ball into a box of another space in step 22.
SharedModel collision_course() {
  return share(testing_support::on_collision_course(testing_support::neighbours()));
}

struct GuardedRun {
  WorldRunResult result;
  std::vector<stepping::RunEvent> events;
};

stability::GuardSettings guards_of(OnBlowup on_blowup, const stepping::StepperSettings& settings) {
  return {on_blowup,
          settings,
          [](const stepping::StepperSettings& one) {
            return solver::make_sor_stepper(one, ode::make_narrow_phase);
          },
          {.energy_share = 1e-3, .energy_lift_m = 1e-3}};
}

GuardedRun run_cut(const SharedModel& model, const WorldRunSettings& settings,
                   const stability::GuardSettings& guards) {
  const auto stepper = testing_support::make_space_stepper(model, guards.stepper);
  SpaceDriver driver(world(), *stepper, settings);
  driver.watch(guards);
  Recorder recorder;
  driver.add_observer(recorder);
  WorldRunResult result = driver.run();
  return {std::move(result), std::move(recorder.events)};
}

GuardedRun run_whole(const SharedModel& model, WorldRunSettings settings,
                     const stability::GuardSettings& guards) {
  settings.placement.clear();
  stability::GuardedStepper stepper(guards.make_stepper(guards.stepper), guards);
  WorldDriver driver(
      Communicator(), stepper, [&](int) { return model; }, settings);
  driver.set_event_source(stepper);
  Recorder recorder;
  driver.add_observer(recorder);
  WorldRunResult result = driver.run();
  return {std::move(result), std::move(recorder.events)};
}

std::vector<std::string> details(const std::vector<stepping::RunEvent>& events) {
  std::vector<std::string> found;
  for (const stepping::RunEvent& event : events) {
    if (event.kind != event_kind::rebalance) found.push_back(event.detail);
  }
  return found;
}

class EveryAction : public testing::TestWithParam<OnBlowup> {};
INSTANTIATE_TEST_SUITE_P(Actions, EveryAction,
                         testing::Values(OnBlowup::report, OnBlowup::stop, OnBlowup::freeze,
                                         OnBlowup::refine));

TEST_P(EveryAction, does_to_a_world_in_spaces_what_it_does_to_the_whole_one) {
  const SharedModel model = collision_course();
  WorldRunSettings settings = space_settings();
  settings.stop_at_blowup = GetParam() == OnBlowup::stop;
  settings.rebalance_threshold = model::infinity;
  for (const stepping::Precision precision : {stepping::Precision::double_, stepping::Precision::single}) {
    stepping::StepperSettings stepper = default_settings(stepping::StepperKind::sor, stepping::Law::ode);
    stepper.precision = precision;
    const stability::GuardSettings guards = guards_of(GetParam(), stepper);
    const GuardedRun whole = run_whole(model, settings, guards);
    ASSERT_FALSE(whole.events.empty());
    for (const Placement& placement : placements_of_four_spaces(world().size(), 53)) {
      settings.placement = placement;
      const GuardedRun cut = run_cut(model, settings, guards);
      EXPECT_EQ(cut.result.state_hash, whole.result.state_hash) << testing::PrintToString(placement);
      EXPECT_EQ(details(cut.events), details(whole.events));
      EXPECT_EQ(cut.result.failure, whole.result.failure);
    }
    settings.placement.clear();
  }
}

TEST_P(EveryAction, has_the_same_bits_while_spaces_change_their_owner) {
  const SharedModel model = collision_course();
  WorldRunSettings settings = space_settings();
  settings.rebalance_threshold = 1;
  const stability::GuardSettings guards = guards_of(GetParam(), testing_support::ode_steps);
  EXPECT_EQ(run_cut(model, settings, guards).result.state_hash,
            run_whole(model, settings, guards).result.state_hash);
}

}  // namespace
}  // namespace pbmpi::mpi
