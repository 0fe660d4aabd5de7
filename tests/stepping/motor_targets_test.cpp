#include "stepping/motor_targets.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "support/models.h"

namespace pbmpi::stepping {
namespace {

/// Two hinges; the first one has a motor from the start, the second from step 20 on.
model::Model two_hinges() {
  model::Model model = support::pendulum(1, 0);
  support::add_joint(model, model::JointKind::hinge, 0, model::no_body, {0, 0, 0});
  model.joints[0].motors[0] = {1, 10, 2};
  for (const auto& [step, joint, force] : {std::tuple{5, 0, 30.0}, {20, 1, 40.0}}) {
    model::Event event;
    event.step = step;
    event.kind = model::EventKind::motor;
    event.joint = joint;
    event.motor = {-1, force};
    model.events.push_back(event);
  }
  return model;
}

TEST(MotorTargets, have_force_and_hold_rate_of_the_motor_that_is_there_at_their_step) {
  const model::Model model = two_hinges();
  MotorTargets targets;
  const MotorTargets::Target* target = targets.set(model, 5, 0, 0, 7);  // before the events of step 5
  ASSERT_NE(target, nullptr);
  EXPECT_EQ(target->motor.velocity, 7);
  EXPECT_EQ(target->motor.max_force, 10);
  EXPECT_EQ(target->motor.hold_rate, 2);
  targets.move_to(model, 6);
  EXPECT_EQ(targets.all()[0].motor.velocity, 7);
  EXPECT_EQ(targets.all()[0].motor.max_force, 30);
  EXPECT_EQ(targets.all()[0].motor.hold_rate, 0);
}

TEST(MotorTargets, say_whether_anything_changes) {
  const model::Model model = two_hinges();
  MotorTargets targets;
  EXPECT_EQ(targets.set(model, 0, 0, 0, 1), nullptr) << "the model aims there";
  EXPECT_EQ(targets.all().size(), 1u) << "but at another step it may not";
  EXPECT_NE(targets.set(model, 0, 0, 0, 2), nullptr);
  EXPECT_EQ(targets.set(model, 0, 0, 0, 2), nullptr);
  EXPECT_EQ(targets.all().size(), 1u);
}

TEST(MotorTargets, end_with_an_event_of_their_axis) {
  const model::Model model = two_hinges();
  MotorTargets targets;
  targets.set(model, 0, 1, 0, 3);
  targets.set(model, 0, 0, 0, 2);
  EXPECT_EQ(targets.all()[0].joint, 0) << "sorted";
  targets.pass(model, 0, 5);
  EXPECT_EQ(targets.all().size(), 2u);
  targets.pass(model, 5);
  ASSERT_EQ(targets.all().size(), 1u);
  EXPECT_EQ(targets.all()[0].joint, 1);
  targets.pass(model, 6, 100);
  EXPECT_TRUE(targets.all().empty());
}

TEST(MotorTargets, drive_a_joint_that_a_motor_without_a_hold_rate_turns) {
  const model::Model model = two_hinges();
  MotorTargets targets;
  EXPECT_FALSE(targets.drive(model, 5, 0)) << "with a hold rate it aims at a pose";
  EXPECT_TRUE(targets.drive(model, 6, 0)) << "the event of step 5 has given it another motor";
  EXPECT_FALSE(targets.drive(model, 20, 1));
  EXPECT_TRUE(targets.drive(model, 21, 1));
  targets.set(model, 21, 1, 0, 0);
  EXPECT_FALSE(targets.drive(model, 21, 1));
  EXPECT_TRUE(targets.drive(model, 21, 0)) << "the other joint's has no target";
  targets.set(model, 21, 1, 0, 1e-6);
  EXPECT_TRUE(targets.drive(model, 21, 1)) << "however slowly";
}

TEST(MotorTargets, are_refused_where_no_motor_ever_is) {
  model::Model model = two_hinges();
  model.events.pop_back();
  MotorTargets targets;
  EXPECT_THROW(targets.set(model, 0, 1, 0, 3), core::InputError);
  EXPECT_THROW(targets.set(model, 0, 0, 1, 3), core::InputError);
  EXPECT_TRUE(targets.all().empty());
}

}  // namespace
}  // namespace pbmpi::stepping
