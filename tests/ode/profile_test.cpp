#include <gtest/gtest.h>

#include <memory>
#include <numeric>

#include "ode/ode_stepper.h"
#include "simulation.h"
#include "stepping/stepper_traits.h"
#include "support/models.h"

namespace pbmpi::ode {
namespace {

stepping::StepperSettings profiling(stepping::StepperKind kind) {
  stepping::StepperSettings settings = default_settings(kind);
  settings.profile = true;
  return settings;
}

std::unique_ptr<stepping::WorldStepper> stepper_with(const model::Model& model,
                                                     const stepping::StepperSettings& settings) {
  auto stepper = make_ode_stepper(settings, [](const std::string&) {});
  stepper->add(0, std::make_shared<model::Model>(model), model::initial_state(model), 0);
  return stepper;
}

/// The bits after 40 steps, profiled every third step or never.
std::uint64_t hash_of(const model::Model& model, const stepping::StepperSettings& settings, bool profile) {
  const auto stepper = stepper_with(model, settings);
  core::PhaseTimes times;
  for (int frame = 0; frame < 13; ++frame) {
    stepper->advance(3, times);
    if (profile) stepper->profile_last_step();
  }
  return model::hash(stepper->state(0));
}

TEST(StepProfile, changes_no_bit_of_the_run) {
  for (const auto kind : {stepping::StepperKind::quick, stepping::StepperKind::direct}) {
    const auto settings = profiling(kind);
    EXPECT_EQ(hash_of(support::crash(), settings, true), hash_of(support::crash(), settings, false));
    EXPECT_EQ(hash_of(support::pile(8), settings, true), hash_of(support::pile(8), settings, false));
  }
}

TEST(StepProfile, a_launch_in_the_last_step_is_not_fired_twice) {
  model::Model model = support::pile(3);
  model::Event launch;
  launch.step = 5;
  launch.body = 2;
  launch.velocity = model::Vec3(4, 0, 2);
  model.events.push_back(launch);
  const auto settings = profiling(stepping::StepperKind::quick);
  EXPECT_EQ(hash_of(model, settings, true), hash_of(model, settings, false));
}

TEST(StepProfile, a_joint_that_broke_in_the_last_step_acts_in_its_profile) {
  model::Model model = support::pendulum(1, 1.5);
  model.joints[0].break_force = 20;  // twice its weight, on its way down
  const auto settings = profiling(stepping::StepperKind::quick);
  EXPECT_EQ(hash_of(model, settings, true), hash_of(model, settings, false));
  const auto stepper = stepper_with(model, settings);
  core::PhaseTimes times;
  do {
    stepper->advance(1, times);
    stepper->profile_last_step();
    ASSERT_EQ(stepper->observables(0).rows, 5);
    ASSERT_EQ(stepper->profile(0)->islands.front().rows, 5) << "the hinge's";
  } while (!stepper->state(0).is_broken(0));
  stepper->advance(1, times);
  stepper->profile_last_step();
  EXPECT_EQ(stepper->observables(0).rows, 0);
  EXPECT_EQ(stepper->profile(0)->islands.front().rows, 0);
}

TEST(StepProfile, counts_what_the_observables_of_the_step_count) {
  const auto stepper = stepper_with(support::crash(), profiling(stepping::StepperKind::quick));
  core::PhaseTimes times;
  for (int frame = 0; frame < 10; ++frame) {
    stepper->advance(3, times);
    stepper->profile_last_step();
    const stepping::StepProfile* profile = stepper->profile(0);
    ASSERT_NE(profile, nullptr);
    const stepping::Observables& seen = stepper->observables(0);
    int bodies = 0, rows = 0, contacts = 0;
    for (const stepping::IslandCost& island : profile->islands) {
      bodies += island.bodies;
      rows += island.rows;
      contacts += island.contacts;
      EXPECT_GE(island.solve_s, 0);
    }
    EXPECT_EQ(std::ssize(profile->islands), seen.islands);
    EXPECT_EQ(bodies, stepper->state(0).num_bodies());
    EXPECT_EQ(rows, seen.rows);
    EXPECT_EQ(contacts, seen.contacts);
    EXPECT_GT(profile->collide_s, 0);
  }
}

TEST(StepProfile, a_large_island_costs_more_than_a_single_body) {
  model::Model model = support::chain(40);
  const int actor = support::add_actor(model, "ball");
  const int ball =
      support::add_solid(model, actor, "ball", model::Shape::sphere, {0.1, 0, 0}, 1, model::Vec3(0, 50, 50));
  const auto stepper = stepper_with(model, profiling(stepping::StepperKind::quick));
  core::PhaseTimes times;
  stepper->advance(3, times);
  stepper->profile_last_step();
  const auto& islands = stepper->profile(0)->islands;
  ASSERT_EQ(islands.size(), 2u);
  EXPECT_EQ(islands[0].bodies, 40);
  EXPECT_EQ(islands[1].first_body, ball);
  // 120 rows and 20 sweeps against none: a factor above 20, of which 2 is required.
  EXPECT_GT(islands[0].solve_s, 2 * islands[1].solve_s);
}

TEST(StepProfile, leaves_islands_inside_and_outside_of_a_field_of_interest_as_they_were) {
  model::Model model = support::crash();
  model.interest = model::Interest{model.bodies.back().pose.position, model::no_body, 1, 3};
  const stepping::StepperSettings settings = profiling(stepping::StepperKind::quick);
  EXPECT_EQ(hash_of(model, settings, true), hash_of(model, settings, false));
  const auto stepper = stepper_with(model, settings);
  core::PhaseTimes times;
  stepper->advance(1, times);
  EXPECT_GT(stepper->observables(0).bodies_inside, 0);
  EXPECT_LT(stepper->observables(0).bodies_inside, model.num_bodies());
}

TEST(StepProfile, counts_contacts_between_spaces_but_not_with_the_ground) {
  model::Model model = support::pile(2);
  core::PhaseTimes times;
  const auto cross_contacts = [&] {
    const auto stepper = stepper_with(model, profiling(stepping::StepperKind::quick));
    for (int frame = 0; frame < 10; ++frame) stepper->advance(3, times);
    stepper->profile_last_step();
    EXPECT_GT(stepper->observables(0).contacts, 0);
    return stepper->profile(0)->cross_contacts;
  };
  EXPECT_EQ(cross_contacts(), 0);
  model.spaces = {"lower", "upper"};
  for (model::Geom& geom : model.geoms) geom.space = geom.body == 1 ? 1 : 0;
  EXPECT_GT(cross_contacts(), 0);
}

TEST(StepProfile, is_absent_unless_asked_for) {
  const auto stepper = stepper_with(support::crash(), {});
  core::PhaseTimes times;
  stepper->advance(3, times);
  stepper->profile_last_step();
  EXPECT_EQ(stepper->profile(0), nullptr);
}

}  // namespace
}  // namespace pbmpi::ode
