// The effects that act around the step, in Bullet's worlds.
#include <algorithm>

#include <gtest/gtest.h>

#include "simulation.h"
#include "support/models.h"

namespace pbmpi::bullet {
namespace {

using model::Model;
using model::Shape;
using model::Vec3;

int num_asleep(const model::State& state) {
  return static_cast<int>(std::ranges::count_if(state.rest, &model::Rest::asleep));
}

/// Two boxes side by side, and a ball that is launched at the first in step 150.
Model sleepy() {
  Model model = support::box_over_ground(0);
  support::add_solid(model, 1, "other", Shape::box, {1, 1, 1}, 10, {0, 5, 0.5});
  const int actor = support::add_actor(model, "ball");
  const int ball = support::add_solid(model, actor, "ball", Shape::sphere, {0.2, 0, 0}, 5, {4, 0, 0.2});
  model::Event event;
  event.step = 150;
  event.body = ball;
  event.velocity = {-12, 0, 1};
  model.events.push_back(event);
  model.effects["sleeping"] = true;
  return model;
}

TEST(Sleeping, bodies_keep_their_bits_and_wake_when_touched) {
  const auto settings = settings_of(0.01, 20);
  Simulation simulation(sleepy(), settings);
  simulation.advance(140);
  ASSERT_EQ(num_asleep(simulation.state()), 3);
  EXPECT_EQ(simulation.observables().rows, 0);
  const std::uint64_t settled = model::hash(simulation.state());
  simulation.advance(5);
  EXPECT_EQ(model::hash(simulation.state()), settled);
  Simulation again(sleepy(), simulation.state(), 145, settings);
  simulation.advance(60);
  again.advance(60);
  EXPECT_EQ(model::hash(simulation.state()), model::hash(again.state()));
  EXPECT_FALSE(simulation.state().rest[0].asleep());
  EXPECT_TRUE(simulation.state().rest[1].asleep());
  EXPECT_LT(simulation.state().position[0].x(), -0.01);
}

/// A box of 12 kg that hangs on the world by a joint of this strength [N].
Model hanging(double strength) {
  Model model;
  const int actor = support::add_actor(model, "load");
  support::add_solid(model, actor, "load", Shape::box, {0.4, 0.4, 0.4}, 12, {0, 0, 2});
  support::add_joint(model, model::JointKind::ball, 0, model::no_body, {0, 0, 2.5});
  model.joints[0].break_force = strength;
  return model;
}

TEST(BreakableJoints, break_above_their_strength) {
  constexpr double weight = 12 * 9.81;
  for (const double share : {0.99, 1.01}) {
    Simulation simulation(hanging(share * weight), settings_of(0.01, 50));
    simulation.advance(20);
    EXPECT_EQ(simulation.state().is_broken(0), share < 1) << share;
    EXPECT_EQ(simulation.state().position[0].z() < 1.9, share < 1) << share;
  }
}

TEST(BreakableJoints, are_released_by_events_and_stay_so_in_a_state_from_elsewhere) {
  Model model = hanging(0);
  model::Event event;
  event.step = 10;
  event.kind = model::EventKind::release;
  event.joint = 0;
  model.events.push_back(event);
  const auto settings = settings_of(0.01, 50);
  Simulation simulation(model, settings);
  simulation.advance(10);
  EXPECT_NEAR(simulation.state().position[0].z(), 2, 0.01);
  Simulation again(model, simulation.state(), 10, settings);
  for (Simulation* one : {&simulation, &again}) one->advance(30);
  EXPECT_NEAR(simulation.state().position[0].z(), 2 - 9.81 * 0.01 * 0.01 * 30 * 31 / 2, 0.01);
  EXPECT_EQ(model::hash(simulation.state()), model::hash(again.state()));
}

TEST(FastBodies, do_not_pass_through_a_thin_wall) {
  for (const bool looks_ahead : {false, true}) {
    Model model;
    const int wall = support::add_actor(model, "wall");
    support::add_solid(model, wall, "wall", Shape::box, {0.02, 4, 4}, 500, {0, 0, 0});
    const int actor = support::add_actor(model, "ball");
    support::add_solid(model, actor, "ball", Shape::sphere, {0.1, 0, 0}, 1, {-2.5, 0.1, 0.1});
    model.gravity.setZero();
    model.bodies[1].velocity = {100, 0, 0};  // 1 m a step
    model.effects["fast_bodies"] = looks_ahead;
    Simulation simulation(model, settings_of(0.01, 20));
    int most_fast = 0;
    for (int step = 0; step < 10; ++step) {
      simulation.advance(1);
      most_fast = std::max(most_fast, simulation.observables().fast_bodies);
    }
    EXPECT_EQ(simulation.state().position[1].x() < 0.3, looks_ahead) << simulation.state().position[1].x();
    EXPECT_EQ(most_fast > 0, looks_ahead);
  }
}

TEST(Drag, slows_bodies_down) {
  Model model = support::free_box();
  model.gravity.setZero();
  model.air_density = 50;
  Simulation simulation(model, settings_of(0.01, 10));
  simulation.advance(50);
  EXPECT_LT(simulation.state().velocity[0].norm(), 0.8 * model.bodies[0].velocity.norm());
}

}  // namespace
}  // namespace pbmpi::bullet
