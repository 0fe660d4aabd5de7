#include <cmath>

#include <gtest/gtest.h>

#include "simulation.h"
#include "stepping/step_contacts.h"
#include "support/models.h"

namespace pbmpi::bullet {
namespace {

using model::Model;
using model::Shape;
using model::Vec3;

/// One body of this shape at rest on the ground, or on a static box that is as large as a table.
Model resting(Shape shape, const std::array<double, 3>& size, double height, const model::Quat& turn,
              bool on_box) {
  Model model;
  support::add_ground(model);
  if (on_box) {
    model.geoms[0].shape = Shape::box;
    model.geoms[0].size = {4, 4, 1};
    model.geoms[0].local.position = {0, 0, -0.5};
  }
  const int actor = support::add_actor(model, "body");
  support::add_solid(model, actor, "body", shape, size, 2, {0, 0, height}, turn);
  return model;
}

struct Lying {
  const char* name;
  Shape shape;
  std::array<double, 3> size;
  double height;  ///< of the centre of mass at rest [m]
  double angle;   ///< about x [rad]
};
void PrintTo(const Lying& one, std::ostream* out) { *out << one.name; }

constexpr double quarter = 1.5707963267948966;

class EveryShape : public testing::TestWithParam<Lying> {};
INSTANTIATE_TEST_SUITE_P(Contacts, EveryShape,
                         testing::Values(Lying{"box", Shape::box, {0.6, 0.4, 0.2}, 0.1, 0},
                                         Lying{"sphere", Shape::sphere, {0.2}, 0.2, 0},
                                         Lying{"capsule", Shape::capsule, {0.1, 0.5}, 0.1, quarter},
                                         Lying{"cylinder", Shape::cylinder, {0.2, 0.5}, 0.2, quarter},
                                         Lying{"disc", Shape::cylinder, {0.3, 0.2}, 0.1, 0}),
                         [](const auto& one) { return std::string(one.param.name); });

TEST_P(EveryShape, lies_still_on_a_plane_and_on_a_box) {
  for (const bool on_box : {false, true}) {
    const Lying& lying = GetParam();
    const model::Quat turn = support::rotation(Vec3::UnitX(), lying.angle);
    Simulation simulation(resting(lying.shape, lying.size, lying.height, turn, on_box),
                          settings_of(0.005, 20));
    simulation.advance(400);
    const model::State& state = simulation.state();
    EXPECT_NEAR(state.position[0].z(), lying.height, 0.004) << on_box;
    EXPECT_LT(state.position[0].head<2>().norm(), 0.03) << on_box;
    EXPECT_LT(state.velocity[0].norm(), 0.02) << on_box;
    EXPECT_LT(state.orientation[0].to_eigen().angularDistance(turn.to_eigen()), 0.1) << on_box;
  }
}

TEST(Contacts, carry_the_weight_of_what_rests_on_them) {
  Model model = resting(Shape::box, {0.6, 0.4, 0.2}, 0.1, {}, false);
  stepping::StepperSettings settings = settings_of(0.005, 50);
  settings.contacts = true;
  Simulation simulation(model, settings);
  simulation.advance(300);
  const stepping::StepContacts* seen = simulation.stepper().contacts(0);
  ASSERT_NE(seen, nullptr);
  ASSERT_EQ(seen->contacts.size(), 4);
  double normal = 0;
  for (const auto& [contact, force] : seen->contacts) {
    EXPECT_EQ(contact.body_a, 0);
    EXPECT_EQ(contact.body_b, model::no_body);
    EXPECT_GT(contact.normal.z(), 0.999);
    normal += force.normal;
    EXPECT_NEAR(force.arm.z(), -0.1, 0.005);
  }
  EXPECT_NEAR(normal, 2 * 9.81, 0.1);
}

TEST(Contacts, hold_by_the_friction_of_their_pair) {
  Model model = resting(Shape::box, {0.6, 0.4, 0.2}, 0.1, {}, false);
  stepping::StepperSettings settings = settings_of(0.005, 50);
  settings.contacts = true;
  model.gravity = {3, 0, -9.81};
  model.geoms[0].material.mu = 0.1;
  model.pair_materials.push_back({0, 1, {0.9, 0}});
  Simulation simulation(model, settings);
  simulation.advance(100);
  const stepping::StepContacts& seen = *simulation.stepper().contacts(0);
  Vec3 friction = Vec3::Zero();
  for (const model::LoadedContact& one : seen.contacts) friction += one.force.friction;
  EXPECT_NEAR(friction.x(), -6, 0.3);  // 2 kg x 3 m/s^2
  EXPECT_LT(simulation.state().velocity[0].norm(), 0.01);
}

TEST(Contacts, are_none_between_geoms_that_may_not_touch) {
  Model model = support::chain(2);
  Simulation jointed(model, settings_of(0.005, 20));
  jointed.advance(10);
  EXPECT_EQ(jointed.observables().contacts, 0);
}

TEST(Contacts, show_the_forces_of_joints) {
  Model model = support::pendulum(1, 0);
  stepping::StepperSettings settings = settings_of(0.005, 50);
  settings.contacts = true;
  Simulation simulation(model, settings);
  simulation.advance(50);
  const stepping::StepContacts& seen = *simulation.stepper().contacts(0);
  ASSERT_EQ(seen.joints.size(), 1);
  EXPECT_NEAR(seen.joints[0].force.z(), 9.81, 0.02);  // 1 kg hangs or stands there
  EXPECT_LT(seen.joints[0].torque.norm(), 0.02);
}

}  // namespace
}  // namespace pbmpi::bullet
