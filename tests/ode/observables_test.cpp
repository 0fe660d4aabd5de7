/// Rows, islands and the other numbers that a stepper reports.
#include <gtest/gtest.h>

#include "model/mechanics.h"
#include "simulation.h"
#include "stepping/stepper_traits.h"
#include "support/models.h"

namespace pbmpi::ode {
namespace {

using model::Model;
using model::Shape;
using model::Vec3;

const stepping::StepperSettings plain = default_settings(stepping::StepperKind::quick);

TEST(Observables, count_each_body_without_contact_as_an_island) {
  Model model;
  const int actor = support::add_actor(model, "balls");
  for (int i = 0; i < 5; ++i) {
    support::add_solid(model, actor, "ball" + std::to_string(i), Shape::sphere, {0.1, 0, 0}, 1,
                       {1.0 * i, 0, 5});
  }
  Simulation simulation(model, plain);
  simulation.advance(1);
  EXPECT_EQ(simulation.observables().islands, 5);
  EXPECT_EQ(simulation.observables().rows, 0);
  EXPECT_EQ(simulation.observables().max_island_rows, 0);
}

TEST(Observables, do_not_join_islands_through_the_ground) {
  Model model;
  support::add_ground(model);
  const int actor = support::add_actor(model, "balls", model::ActorKind::prop, true);
  for (int i = 0; i < 3; ++i) {
    support::add_solid(model, actor, "ball" + std::to_string(i), Shape::sphere, {0.5, 0, 0}, 1,
                       {2.0 * i, 0, 0.4999});
  }
  support::add_solid(model, actor, "top", Shape::sphere, {0.5, 0, 0}, 1, {0, 0, 1.4998});
  Simulation simulation(model, plain);
  simulation.advance(1);
  EXPECT_EQ(simulation.observables().islands, 3);
  EXPECT_EQ(simulation.observables().contacts, 4);
  EXPECT_EQ(simulation.observables().rows, 12);
  EXPECT_EQ(simulation.observables().max_island_rows, 6);  // the two balls above each other
}

TEST(Observables, count_limits_and_motors_as_rows_only_while_they_act) {
  Model model = support::pendulum(1, 0.5);
  model.joints[0].limits[0] = {-2, 2};
  Simulation free(model, plain);
  free.advance(1);
  EXPECT_EQ(free.observables().rows, 5);
  model.joints[0].limits[0] = {0, 2};
  Simulation stopped(model, plain);
  stopped.advance(1);
  EXPECT_EQ(stopped.observables().rows, 6);
  model.joints[0].motors[0] = {0, 1};  // stop and motor share one row
  Simulation both(model, plain);
  both.advance(1);
  EXPECT_EQ(both.observables().rows, 6);
}

TEST(Observables, follow_the_crash_from_three_islands_to_one) {
  Simulation simulation(support::crash(), plain);
  simulation.advance(1);
  EXPECT_EQ(simulation.observables().islands, 3);
  int fewest = 3;
  for (int i = 0; i < 60; ++i) {
    simulation.advance(1);
    fewest = std::min(fewest, simulation.observables().islands);
  }
  EXPECT_EQ(fewest, 1);
}

TEST(Observables, give_the_energy_of_the_last_state) {
  Simulation simulation(support::free_box(), plain);
  simulation.advance(7);
  EXPECT_EQ(simulation.energy(), model::mechanical_energy(simulation.model(), simulation.state()));
  simulation.advance(1);
  EXPECT_EQ(simulation.energy(), model::mechanical_energy(simulation.model(), simulation.state()));
}

}  // namespace
}  // namespace pbmpi::ode
