// --tolerance and tall islands in a world cut into spaces.
#include <gtest/gtest.h>

#include <array>

#include "space_run.h"
#include "stepping/step_options.h"

namespace pbmpi::mpi {
namespace {

using testing_support::neighbours;
using testing_support::Oracle;
using testing_support::placements_of_four_spaces;
using testing_support::run_spaces;
using testing_support::share;
using testing_support::SharedModel;
using testing_support::space_settings;
using testing_support::SpaceRun;
using testing_support::whole_hash;
using testing_support::world;

/// With soft contacts a body that stands on another one already makes the island tall.
stepping::StepperSettings settings_with(double tolerance_m, double contact_hz = model::infinity) {
  stepping::StepperSettings stepper = default_settings(stepping::StepperKind::sor);
  stepper.tolerance_m = tolerance_m;
  stepper.law.contact_frequency = contact_hz;
  return stepper;
}

const std::array<stepping::StepperSettings, 3> settings_that_differ = {
    settings_with(1e-4), settings_with(0, 5), settings_with(1e-4, 5)};

TEST(SpaceIslandShares, have_the_bits_of_the_whole_world_for_every_ownership) {
  WorldRunSettings settings = space_settings(40);
  settings.rebalance_threshold = model::infinity;
  const SharedModel model = share(neighbours());
  for (const stepping::Precision precision : {stepping::Precision::double_, stepping::Precision::single}) {
    for (stepping::StepperSettings stepper : settings_that_differ) {
      stepper.precision = precision;
      const std::uint64_t expected = whole_hash(model, settings, stepper);
      stepping::StepperSettings same = settings_with(0, stepper.law.contact_frequency);
      same.precision = precision;
      same.law.most_substeps = same.substeps;
      EXPECT_NE(whole_hash(model, settings, same), expected) << "some islands get more or less";
      for (const Placement& placement : placements_of_four_spaces(world().size(), 47)) {
        settings.placement = placement;
        const SpaceRun run = run_spaces(world(), model, settings, stepper, Oracle::none);
        ASSERT_EQ(run.result.state_hash, expected) << testing::PrintToString(placement);
      }
    }
  }
}

TEST(SpaceIslandShares, have_the_bits_of_the_whole_world_while_spaces_change_their_owner) {
  WorldRunSettings settings = space_settings(40);
  settings.placement = {0, 0, 0, 0};
  settings.rebalance_threshold = 1;
  const SharedModel model = share(neighbours());
  for (const stepping::StepperSettings& stepper : settings_that_differ) {
    const SpaceRun run = run_spaces(world(), model, settings, stepper, Oracle::none);
    EXPECT_EQ(run.result.state_hash, whole_hash(model, settings, stepper));
    EXPECT_EQ(run.events.empty(), world().size() == 1);
  }
}

TEST(SpaceIslandShares, have_the_bits_of_the_whole_world_where_islands_sleep_and_a_field_is_of_interest) {
  model::Model model = neighbours();
  model.effects["sleeping"] = true;
  model.sleep.after_s = 0.2;
  model.interest = model::Interest{{1, 0, 3}, model::no_body, 1, 1};
  const SharedModel shared = share(model);
  const WorldRunSettings settings = space_settings(60);
  for (stepping::StepperSettings stepper : settings_that_differ) {
    stepper.iterations = 2;
    EXPECT_EQ(run_spaces(world(), shared, settings, stepper, Oracle::none).result.state_hash,
              whole_hash(shared, settings, stepper));
  }
}

}  // namespace
}  // namespace pbmpi::mpi
