#include "bullet/bullet_stepper.h"

#include <cmath>

#include <gtest/gtest.h>

#include "core/error.h"
#include "simulation.h"
#include "support/models.h"

namespace pbmpi::bullet {
namespace {

using model::Model;

TEST(Stepper, refuses_steps_that_are_none) {
  EXPECT_THROW(make_bullet_stepper(settings_of(0, 10), ""), core::InputError);
  EXPECT_THROW(make_bullet_stepper(settings_of(std::nan(""), 10), ""), core::InputError);
  EXPECT_THROW(make_bullet_stepper(settings_of(0.01, 0), ""), core::InputError);
}

TEST(Stepper, stops_a_world_that_is_not_finite_and_goes_on_with_the_others) {
  for (const double bad : {std::nan(""), model::infinity}) {
    const auto stepper = make_bullet_stepper(settings_of(0.01, 10), "test: ");
    const Model model = support::crash();
    model::State state = model::initial_state(model);
    stepper->add(0, std::make_shared<Model>(model), state, 0);
    state.velocity[3].x() = bad;
    stepper->add(1, std::make_shared<Model>(model), state, 0);
    core::PhaseTimes times;
    for (int i = 0; i < 3; ++i) stepper->advance(5, times);
    EXPECT_GT(stepper->observables(1).nonfinite, 0);
    EXPECT_EQ(stepper->observables(0).nonfinite, 0);
    Simulation alone(model, settings_of(0.01, 10));
    alone.advance(15);
    EXPECT_EQ(model::hash(stepper->state(0)), model::hash(alone.state()));
    stepper->set_state(1, model::initial_state(model), 0);
    stepper->advance(15, times);
    EXPECT_EQ(model::hash(stepper->state(1)), model::hash(alone.state()));
  }
}

TEST(Stepper, survives_a_world_of_enormous_numbers) {
  for (const double big : {1e20, 1e155, 1e300}) {
    Model model = support::pile(4);
    model.bodies[1].velocity = {big, -big, big};
    model.bodies[2].angular_velocity = {big, 0, -big};
    Simulation simulation(model, settings_of(0.01, 10));
    simulation.advance(20);
    SUCCEED() << simulation.observables().nonfinite;
  }
}

TEST(Stepper, says_what_it_counts) {
  Simulation simulation(support::crash(), settings_of(0.01, 10));
  simulation.advance(30);
  const stepping::Observables& seen = simulation.observables();
  EXPECT_GT(seen.contacts, 0);
  EXPECT_GT(seen.rows, 34 * 3);
  EXPECT_EQ(seen.row_visits, 10.0 * seen.rows);
  EXPECT_GT(seen.islands, 0);
  EXPECT_LE(seen.max_island_rows, seen.rows);
  EXPECT_EQ(simulation.stepper().contacts(0), nullptr);
}

TEST(Stepper, aims_motors) {
  Model model = support::pendulum(1, 0);
  model.gravity.setZero();
  model.joints[0].motors[0] = {0, 50};
  Simulation simulation(model, settings_of(0.01, 20));
  simulation.stepper().set_motor_velocity(0, 0, 0, 1.5);
  simulation.advance(20);
  const double spin =
      simulation.state().angular_velocity[0].dot(simulation.direction(0, model.joints[0].axis1_a));
  EXPECT_NEAR(spin, 1.5, 1e-3);
  EXPECT_THROW(simulation.stepper().set_motor_velocity(0, 0, 1, 1), core::InputError);
}

}  // namespace
}  // namespace pbmpi::bullet
