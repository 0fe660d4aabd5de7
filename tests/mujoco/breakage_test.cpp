#include <gtest/gtest.h>

#include "simulation.h"
#include "support/models.h"

namespace pbmpi::mujoco {
namespace {

using model::Event;
using model::EventKind;
using model::JointKind;
using model::Model;
using model::Vec3;

constexpr double g = 9.81;

/// A box of 2 kg fixed to the world, with another one fixed below it.
Model hanging_boxes(double break_force) {
  Model model;
  const int actor = support::add_actor(model, "boxes");
  for (int i = 0; i < 2; ++i)
    support::add_solid(model, actor, "box" + std::to_string(i), model::Shape::box, {1, 1, 1}, 2,
                       {0, 0, 10 - 1.5 * i});
  support::add_joint(model, JointKind::ball, 0, model::no_body, {0, 0, 11});
  support::add_joint(model, JointKind::fixed, 1, 0, {0, 0, 9});
  model.joints[1].break_force = break_force;
  return model;
}

TEST(MujocoBreakage, follows_the_load) {
  Simulation held(hanging_boxes(2 * g * 1.05)), overloaded(hanging_boxes(2 * g * 0.95));
  held.advance(100);
  overloaded.advance(100);
  EXPECT_FALSE(held.state().is_broken(1));
  EXPECT_NEAR(held.state().position[1].z(), 8.5, 1e-9);
  ASSERT_TRUE(overloaded.state().is_broken(1));
  EXPECT_EQ(overloaded.state().broken_in[1], 0);
  EXPECT_NEAR(overloaded.state().velocity[1].z(), -g * 0.99, 1e-9);
  EXPECT_NEAR(overloaded.state().position[0].z(), 10, 1e-9);
}

TEST(MujocoBreakage, takes_the_torque_about_the_anchor) {
  // A beam of 1 m and 1 kg fixed to the world at its end: m g / 2 about there.
  for (const double share : {0.98, 1.02}) {
    Model model;
    const int actor = support::add_actor(model, "beam");
    support::add_solid(model, actor, "beam", model::Shape::box, {1, 0.1, 0.1}, 1, {0.5, 0, 5});
    support::add_joint(model, JointKind::fixed, 0, model::no_body, {0, 0, 5});
    model.joints[0].break_torque = share * g / 2;
    Simulation simulation(model);
    simulation.advance(10);
    EXPECT_EQ(simulation.state().is_broken(0), share < 1);
  }
}

Model released_chain() {
  Model model = support::chain(4);
  Event release;
  release.step = 20;
  release.kind = EventKind::release;
  release.joint = 2;
  model.events.push_back(release);
  return model;
}

TEST(MujocoBreakage, by_an_event_lets_go_at_its_step) {
  const Model model = released_chain();
  Simulation simulation(model);
  simulation.advance(19);
  EXPECT_FALSE(simulation.state().is_broken(2));
  simulation.advance(1);
  EXPECT_TRUE(simulation.state().is_broken(2)) << "from step 20 on";
  const model::State before = simulation.state();
  simulation.advance(50);
  // The centre of the detached bodies moves by gravity alone; 200 roundings of numbers near 10 stay below
  // 1e-10.
  const Vec3 fall = 0.5 * (simulation.state().velocity[2] + simulation.state().velocity[3]) -
                    0.5 * (before.velocity[2] + before.velocity[3]);
  EXPECT_NEAR(fall.z(), -g * 0.5, 0.05 * g * 0.5) << "joints inside keep exchanging momentum within a part";
  EXPECT_LT(simulation.observables().joint_gap_m, 1e-12);
  EXPECT_EQ(simulation.observables().islands, 2);
}

TEST(MujocoBreakage, is_the_same_where_a_world_is_put_back) {
  const Model model = released_chain();
  for (const int first : {10, 19, 20, 21, 30})
    EXPECT_EQ(hash_after(model, 40), hash_after_restore(model, first, 40 - first)) << first;
  const Model overloaded = hanging_boxes(2 * g * 0.95);
  EXPECT_EQ(hash_after(overloaded, 20), hash_after_restore(overloaded, 10, 10));
}

}  // namespace
}  // namespace pbmpi::mujoco
