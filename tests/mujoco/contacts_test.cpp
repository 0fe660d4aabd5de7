#include <cmath>

#include <gtest/gtest.h>

#include "model/contact.h"
#include "mujoco/mujoco_stepper.h"
#include "simulation.h"
#include "support/models.h"

namespace pbmpi::mujoco {
namespace {

using model::Model;
using model::Shape;
using model::Vec3;

constexpr double g = 9.81, slope = 0.3;

/// A box on a plane that slopes down towards x, both with friction `mu`.
Model box_on_slope(double mu) {
  Model model;
  support::add_ground(model);
  const model::Quat turn = support::rotation(Vec3::UnitY(), slope);
  model.geoms[0].local.orientation = turn;
  const int actor = support::add_actor(model, "box");
  support::add_solid(model, actor, "box", Shape::box, {0.4, 0.4, 0.2}, 2, turn.to_eigen() * Vec3(0, 0, 0.1),
                     turn);
  for (model::Geom& geom : model.geoms) geom.material.mu = mu;
  return model;
}

TEST(MujocoContacts, hold_a_box_on_a_slope_below_the_angle_of_friction) {
  Simulation simulation(box_on_slope(std::tan(slope) + 0.1));
  const Vec3 before = simulation.state().position[0];
  simulation.advance(100);
  // Its friction is soft, so the box creeps: by a share of the pull per step.
  EXPECT_LT((simulation.state().position[0] - before).norm(), 2e-3);
}

TEST(MujocoContacts, let_a_box_slide_with_coulomb_friction) {
  const double mu = 0.2;
  Simulation simulation(box_on_slope(mu));
  simulation.advance(100);
  const double expected = g * (std::sin(slope) - mu * std::cos(slope));
  EXPECT_NEAR(simulation.state().velocity[0].norm(), expected, 0.02 * expected);
}

TEST(MujocoContacts, take_the_friction_of_a_pair_by_the_models_rule) {
  // MuJoCo would take the larger of the two, 0.8, and hold the box; the root of the product is 0.179.
  Model model = box_on_slope(0.8);
  model.geoms[1].material.mu = 0.04;
  Simulation simulation(model);
  simulation.advance(100);
  const double expected = g * (std::sin(slope) - std::sqrt(0.8 * 0.04) * std::cos(slope));
  EXPECT_NEAR(simulation.state().velocity[0].norm(), expected, 0.02 * expected);
}

TEST(MujocoContacts, without_friction_have_one_row_each) {
  Simulation simulation(box_on_slope(0));
  simulation.advance(100);
  EXPECT_NEAR(simulation.state().velocity[0].norm(), g * std::sin(slope), 0.01);
  EXPECT_EQ(simulation.observables().rows, simulation.observables().contacts);
}

TEST(MujocoContacts, carry_a_pile_at_rest) {
  Simulation simulation(support::pile(5));
  simulation.advance(300);
  EXPECT_LT(simulation.observables().max_penetration_m, 2e-3);
  EXPECT_EQ(simulation.observables().nonfinite, 0);
  for (const Vec3& velocity : simulation.state().velocity) EXPECT_LT(velocity.norm(), 0.05);
}

TEST(MujocoContacts, are_shown_with_forces_that_carry_the_weight) {
  stepping::StepperSettings settings = settings_with();
  settings.contacts = true;
  Simulation simulation(support::box_over_ground(0), settings);
  simulation.advance(100);
  const stepping::StepContacts* shown = simulation.stepper().contacts(0);
  ASSERT_NE(shown, nullptr);
  ASSERT_EQ(shown->contacts.size(), 4u);
  double carried = 0;
  for (const auto& [contact, force] : shown->contacts) {
    EXPECT_EQ(contact.body_a, 0);
    EXPECT_EQ(contact.body_b, model::no_body);
    EXPECT_GT(contact.normal.z(), 0.999) << "into body a";
    EXPECT_NEAR(force.arm.z(), -0.5, 0.01);
    carried += force.normal;
  }
  EXPECT_NEAR(carried, 10 * g, 1);
}

TEST(MujocoContacts, of_one_actor_are_there_only_with_self_collision) {
  for (const bool self_collision : {false, true}) {
    Model model;
    model.gravity.setZero();
    const int actor = support::add_actor(model, "pair", model::ActorKind::prop, self_collision);
    support::add_solid(model, actor, "a", Shape::sphere, {0.5, 0, 0}, 1, {0, 0, 0});
    support::add_solid(model, actor, "b", Shape::sphere, {0.5, 0, 0}, 1, {0.9, 0, 0});
    Simulation simulation(model);
    simulation.advance(1);
    EXPECT_EQ(simulation.observables().contacts, self_collision ? 1 : 0);
  }
}

TEST(MujocoContacts, with_a_static_geom_of_the_same_actor_are_dropped) {
  Model model = support::box_over_ground(-0.1);
  model.geoms[0].actor = model.geoms[1].actor;
  Simulation simulation(model);
  simulation.advance(1);
  EXPECT_EQ(simulation.observables().contacts, 0);
}

}  // namespace
}  // namespace pbmpi::mujoco
