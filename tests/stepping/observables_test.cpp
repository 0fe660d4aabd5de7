#include "stepping/observables.h"

#include <gtest/gtest.h>

#include "support/models.h"

namespace pbmpi::stepping {
namespace {

/// Numbers of size 10 to 1000 out of some dozen roundings.
constexpr double rounding = 1e-12;

model::Model two_boxes() {
  model::Model model;
  const int actor = support::add_actor(model, "boxes");
  support::add_solid(model, actor, "a", model::Shape::box, {1, 1, 1}, 2, {0, 0, 3});
  support::add_solid(model, actor, "b", model::Shape::box, {1, 1, 1}, 6, {2, 0, 0.5});
  return model;
}

TEST(MechanicalEnergy, of_two_bodies_is_what_a_pencil_gives) {
  model::Model model = two_boxes();
  model.bodies[0].velocity = {3, 0, 4};          // 1/2 * 2 * 25 = 25 J
  model.bodies[1].angular_velocity = {0, 0, 2};  // I = 6 / 6 = 1: 2 J
  const double potential = 2 * 9.81 * 3 + 6 * 9.81 * 0.5;
  EXPECT_NEAR(mechanical_energy(model, model::initial_state(model)), 25 + 2 + potential, rounding * 100);
}

TEST(MechanicalEnergy, takes_the_inertia_in_the_bodys_frame) {
  model::Model model;
  model.gravity.setZero();
  const int actor = support::add_actor(model, "rod");
  const core::Quat quarter =
      support::rotation(core::Vec3::UnitX(), std::acos(-1.0) / 2);  // its z becomes the world's -y
  support::add_solid(model, actor, "rod", model::Shape::box, {0.2, 0.2, 2}, 12, {0, 0, 0}, quarter);
  const double along = 12 * (0.04 + 0.04) / 12;
  model.bodies[0].angular_velocity = {0, 10, 0};
  EXPECT_NEAR(mechanical_energy(model, model::initial_state(model)), 0.5 * along * 100, rounding * 100);
}

TEST(JointGap, is_zero_at_the_start_for_every_kind) {
  for (int kind = 0; kind < model::num_joint_kinds; ++kind) {
    model::Model model = two_boxes();
    support::add_joint(model, static_cast<model::JointKind>(kind), 0, 1, {1, 0, 2});
    EXPECT_NEAR(max_joint_gap(model, model::initial_state(model)), 0, rounding) << "kind " << kind;
  }
}

TEST(JointGap, is_the_distance_of_the_anchors) {
  for (const model::JointKind kind :
       {model::JointKind::ball, model::JointKind::hinge, model::JointKind::universal,
        model::JointKind::hinge2, model::JointKind::fixed}) {
    model::Model model = two_boxes();
    support::add_joint(model, kind, 0, 1, {1, 0, 2});
    model::State state = model::initial_state(model);
    state.position[1] += core::Vec3(0.3, 0, 0.4);
    EXPECT_NEAR(joint_gap(model, state, model.joints[0]), 0.5, rounding);
  }
}

TEST(JointGap, leaves_out_what_may_slide) {
  model::Model model = two_boxes();
  support::add_joint(model, model::JointKind::slider, 0, 1, {1, 0, 2}, core::Vec3::UnitZ());
  support::add_joint(model, model::JointKind::hinge2, 0, 1, {1, 0, 2}, core::Vec3::UnitZ(),
                     core::Vec3::UnitY());
  model.joints[1].suspension.stiffness = 1000;
  model::State state = model::initial_state(model);
  state.position[1] += core::Vec3(0.3, 0, 0.4);
  EXPECT_NEAR(joint_gap(model, state, model.joints[0]), 0.3, rounding);
  EXPECT_NEAR(joint_gap(model, state, model.joints[1]), 0.3, rounding);
}

TEST(JointGap, turns_with_the_first_body) {
  model::Model model = two_boxes();
  support::add_joint(model, model::JointKind::ball, 0, 1, {1, 0, 3});
  model::State state = model::initial_state(model);
  state.orientation[0] =
      support::rotation(core::Vec3::UnitZ(), std::acos(-1.0));  // the anchor goes from x = 1 to -1
  EXPECT_NEAR(joint_gap(model, state, model.joints[0]), 2, rounding);
}

TEST(JointGap, to_the_world_counts_from_the_world_anchor) {
  model::Model model = support::pendulum(1, 0.3);
  model::State state = model::initial_state(model);
  EXPECT_NEAR(max_joint_gap(model, state), 0, rounding);
  state.position[0].y() += 0.01;
  EXPECT_NEAR(max_joint_gap(model, state), 0.01, rounding);
}

TEST(MaxJointGap, is_zero_without_joints) {
  const model::Model model = two_boxes();
  EXPECT_EQ(max_joint_gap(model, model::initial_state(model)), 0);
}

}  // namespace
}  // namespace pbmpi::stepping
