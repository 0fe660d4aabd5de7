// A world of several chunks: its islands move as in a world of one.
#include <gtest/gtest.h>

#include <string>

#include "solver/layout/cells.h"
#include "solver/sor_run.h"
#include "stepping/names.h"
#include "stepping/step_options.h"
#include "support/models.h"

namespace pbmpi::solver {
namespace {

using model::Vec3;

constexpr int boxes_a_town = 300;

/// Stacks of three boxes, 0.8 m apart.
void add_town(model::Model& model, const std::string& name, double x) {
  const int actor = support::add_actor(model, name, model::ActorKind::wall, true);
  for (int i = 0; i < boxes_a_town; ++i) {
    const int stack = i / 3;
    support::add_solid(model, actor, name + std::to_string(i), model::Shape::box, {0.5, 0.5, 0.5}, 2,
                       {x + 0.8 * (stack % 10), 0.8 * (stack / 10), 0.25 + 0.5 * (i % 3)});
  }
}

/// Two towns, one of which a ball leaves for the other; and `others` more towns.
model::Model towns(int others) {
  model::Model model;
  support::add_ground(model);
  add_town(model, "first", 0);
  add_town(model, "second", 20);
  const int actor = support::add_actor(model, "ball", model::ActorKind::projectile);
  const int ball =
      support::add_solid(model, actor, "ball", model::Shape::sphere, {0.3, 0, 0}, 50, {8.5, 1, 0.7});
  model.bodies[static_cast<std::size_t>(ball)].velocity = {60, 2, 0};
  for (int other = 0; other < others; ++other)
    add_town(model, "other" + std::to_string(other), 40 + 20 * other);
  return model;
}

void expect_same_bits(const stepping::StepperSettings& settings) {
  const model::Model alone = towns(0), among = towns(8);
  const int most = bodies_in_cache(settings.precision == stepping::Precision::single ? 4 : 8);
  ASSERT_LE(alone.num_bodies(), most);
  ASSERT_GT(among.num_bodies(), most);
  const auto small = make_stepper(settings, {alone}), large = make_stepper(settings, {among});
  advance(*small, 40);  // the ball comes to the second town after 20
  advance(*large, 40);
  for (int body = 0; body < alone.num_bodies(); ++body) {
    ASSERT_EQ(small->state(0).position[body], large->state(0).position[body]) << body;
    ASSERT_EQ(small->state(0).velocity[body], large->state(0).velocity[body]) << body;
  }
  const Vec3 moved = large->state(0).position[boxes_a_town] - among.bodies[boxes_a_town].pose.position;
  EXPECT_GT(moved.norm(), 1e-6);
}

stepping::StepperSettings settings_of(stepping::Law law, stepping::Precision precision) {
  stepping::StepperSettings settings = default_settings(stepping::StepperKind::sor, law);
  settings.precision = precision;
  settings.substeps = 3;
  settings.iterations = 2;
  return settings;
}

TEST(StepChunks, give_islands_the_bits_that_they_have_in_one_chunk) {
  for (const stepping::Precision precision : {stepping::Precision::double_, stepping::Precision::single}) {
    for (const stepping::Law law : {stepping::Law::soft, stepping::Law::ode})
      expect_same_bits(settings_of(law, precision));
  }
}

TEST(StepChunks, give_fine_islands_the_bits_that_they_have_in_one_chunk) {
  for (const stepping::Precision precision : {stepping::Precision::double_, stepping::Precision::single}) {
    stepping::StepperSettings settings = settings_of(stepping::Law::soft, precision);
    settings.approach_m = 0.05;
    expect_same_bits(settings);
  }
}

/// Two bodies on a ball joint, which turn about each other.
void add_pair(model::Model& model, const std::string& name, double x) {
  const int actor = support::add_actor(model, name, model::ActorKind::prop);
  int bodies[2];
  for (const int i : {0, 1}) {
    bodies[i] = support::add_solid(model, actor, name + std::to_string(i), model::Shape::box, {0.4, 0.2, 0.1},
                                   2, {x + 0.5 * i, 0, 50});
    model.bodies[static_cast<std::size_t>(bodies[i])].velocity = {0, 3.0 * i, 1};
  }
  support::add_joint(model, model::JointKind::ball, bodies[0], bodies[1], {x + 0.25, 0, 50});
}

/// Two pairs far apart, and `num_balls` that fall between them.
model::Model pairs(int num_balls) {
  model::Model model;
  add_pair(model, "first", -10);
  add_pair(model, "second", 1010);
  for (const int body : {0, 2}) {  // a launch breaks what the joints' rows of the step before have held
    model::Event event;
    event.step = 3;
    event.body = body;
    event.velocity = {2, -4, 3};
    model.events.push_back(event);
  }
  const int actor = support::add_actor(model, "balls", model::ActorKind::wall, true);
  for (int i = 0; i < num_balls; ++i)
    support::add_solid(model, actor, "ball" + std::to_string(i), model::Shape::sphere, {0.1, 0, 0}, 1,
                       {static_cast<double>(i), 0, 50});
  return model;
}

TEST(StepChunks, are_not_mixed_where_newtons_method_ends_the_sweeps) {
  const model::Model alone = pairs(0), among = pairs(1000);
  ASSERT_GT(among.num_bodies(), bodies_in_cache(8));
  const stepping::StepperSettings settings =
      default_settings(stepping::StepperKind::sor, stepping::Law::coulomb);
  const auto small = make_stepper(settings, {alone}), large = make_stepper(settings, {among});
  advance(*small, 5);
  advance(*large, 5);
  for (int body = 0; body < alone.num_bodies(); ++body) {
    EXPECT_EQ(small->state(0).position[body], large->state(0).position[body]) << body;
    EXPECT_EQ(small->state(0).velocity[body], large->state(0).velocity[body]) << body;
  }
}

TEST(StepChunks, count_in_the_residuals_of_a_world) {
  stepping::StepperSettings settings = default_settings(stepping::StepperKind::sor);
  settings.residuals = true;
  const model::Model alone = towns(0), among = towns(4);
  const auto small = make_stepper(settings, {alone}), large = make_stepper(settings, {among});
  advance(*small, 25);
  advance(*large, 25);
  EXPECT_GT(small->observables(0).residuals.natural_speed, 0);
  EXPECT_GE(large->observables(0).residuals.natural_speed, small->observables(0).residuals.natural_speed);
}

}  // namespace
}  // namespace pbmpi::solver
