// Motors whose targets are set from outside, in all steppers: quick, direct and sor.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <ostream>
#include <string>

#include "core/error.h"
#include "ode/ode_stepper.h"
#include "solver/sor_run.h"
#include "stepping/step_options.h"
#include "support/models.h"

namespace pbmpi::solver {
namespace {

using model::JointKind;
using model::Model;
using model::State;
using model::Vec3;
using stepping::StepperKind;
using stepping::StepperSettings;

struct Setting {
  std::string name;
  StepperSettings settings;
};
std::ostream& operator<<(std::ostream& out, const Setting& setting) { return out << setting.name; }

std::vector<Setting> every_setting() {
  StepperSettings sor = default_settings(StepperKind::sor), single = sor;
  single.precision = stepping::Precision::single;
  return {{"quick", default_settings(StepperKind::quick)},
          {"direct", default_settings(StepperKind::direct)},
          {"sor", sor},
          {"sor_single", single},
          {"sor_ode_law", default_settings(StepperKind::sor, stepping::Law::ode)}};
}

std::unique_ptr<stepping::WorldStepper> start(const StepperSettings& settings, const Model& model,
                                              int num_worlds = 1) {
  auto stepper = settings.kind == StepperKind::sor
                     ? make_stepper(settings)
                     : ode::make_ode_stepper(settings, [](const std::string&) {});
  for (int world = 0; world < num_worlds; ++world)
    stepper->add(world, std::make_shared<const Model>(model), initial_state(model), 0);
  return stepper;
}

std::uint64_t hash_of(const stepping::WorldStepper& stepper, int world = 0) {
  return model::hash(stepper.state(world));
}

/// A box of 1 kg on a joint to the world, along or about y, without gravity.
Model driven_box(JointKind kind, const model::AxisMotor& motor) {
  Model model;
  model.gravity.setZero();
  const int actor = support::add_actor(model, "drive");
  support::add_solid(model, actor, "box", model::Shape::box, {0.4, 0.4, 0.4}, 1, {0, 0, 1});
  support::add_joint(model, kind, 0, model::no_body, {0, 0, 1}, Vec3::UnitY());
  model.joints[0].motors[0] = motor;
  return model;
}

model::Event motor_event(std::int64_t step, const model::AxisMotor& motor) {
  model::Event event;
  event.step = step;
  event.kind = model::EventKind::motor;
  event.joint = 0;
  event.motor = motor;
  return event;
}

class Motors : public testing::TestWithParam<Setting> {
 protected:
  const StepperSettings& settings() const { return GetParam().settings; }
  /// Velocity along or about y, of the only body. Single precision rounds at 1e-7 of it.
  static void expect_rate(const State& state, bool slides, double rate) {
    const Vec3& found = slides ? state.velocity[0] : state.angular_velocity[0];
    EXPECT_NEAR(found.y(), rate, 1e-5);
    EXPECT_NEAR(found.x(), 0, 1e-5);
    EXPECT_NEAR(found.z(), 0, 1e-5);
  }
};
INSTANTIATE_TEST_SUITE_P(EveryStepper, Motors, testing::ValuesIn(every_setting()),
                         [](const auto& test) { return test.param.name; });

TEST_P(Motors, hinge_and_slider_reach_the_velocity_they_are_aimed_at) {
  for (const bool slides : {false, true}) {
    const Model model = driven_box(slides ? JointKind::slider : JointKind::hinge, {0, 5});
    const auto stepper = start(settings(), model);
    advance(*stepper, 5);
    expect_rate(stepper->state(0), slides, 0);
    for (const double velocity : {1.5, -0.5}) {
      stepper->set_motor_velocity(0, 0, 0, velocity);
      advance(*stepper, 60);
      expect_rate(stepper->state(0), slides, velocity);
    }
  }
}

TEST_P(Motors, keep_the_force_of_their_model) {
  // A slider: 5 N on 1 kg give 5 m/s^2.
  const auto stepper = start(settings(), driven_box(JointKind::slider, {0, 5}));
  stepper->set_motor_velocity(0, 0, 0, 100);
  advance(*stepper, 20);
  expect_rate(stepper->state(0), true, 5 * 0.2);
}

TEST_P(Motors, that_hold_a_pose_stand_where_velocity_and_hold_rate_are_in_balance) {
  const auto stepper = start(settings(), driven_box(JointKind::hinge, {0, 50, 10}));
  stepper->set_motor_velocity(0, 0, 0, 4);
  advance(*stepper, 300);
  const core::Quat& q = stepper->state(0).orientation[0];
  // 4 rad/s - 10 / s x angle = 0, from which 3 s are 30 time constants away.
  EXPECT_NEAR(2 * std::atan2(q.y, q.w), 0.4, 1e-5);
}

TEST_P(Motors, aimed_where_their_model_aims_change_no_bit) {
  const Model model = support::crash();
  const auto aimed = start(settings(), model), other = start(settings(), model);
  advance(*aimed, 8);
  advance(*other, 8);
  for (int joint = 0; joint < model.num_joints(); ++joint) {
    for (const int axis : {0, 1}) {
      const model::AxisMotor& motor = model.joints[joint].motors[axis];
      if (motor.active()) aimed->set_motor_velocity(0, joint, axis, motor.velocity);
    }
  }
  advance(*aimed, 12);
  advance(*other, 12);
  EXPECT_EQ(hash_of(*aimed), hash_of(*other));
}

TEST_P(Motors, follow_the_next_event_of_their_axis) {
  Model model = driven_box(JointKind::hinge, {0, 5});
  model.events.push_back(motor_event(10, {-1, 20}));
  const auto stepper = start(settings(), model);
  stepper->set_motor_velocity(0, 0, 0, 0.5);
  advance(*stepper, 10);
  expect_rate(stepper->state(0), false, 0.5);
  advance(*stepper, 20);
  expect_rate(stepper->state(0), false, -1);
  stepper->set_motor_velocity(0, 0, 0, 2);
  advance(*stepper, 20);
  expect_rate(stepper->state(0), false, 2);
}

TEST_P(Motors, that_only_an_event_brings_can_be_aimed) {
  Model model = driven_box(JointKind::slider, {});
  model.events.push_back(motor_event(3, {0, 5}));
  const auto stepper = start(settings(), model);
  stepper->set_motor_velocity(0, 0, 0, 1);
  advance(*stepper, 3);
  expect_rate(stepper->state(0), true, 0);
  stepper->set_motor_velocity(0, 0, 0, 1);
  advance(*stepper, 2);
  EXPECT_EQ(stepper->state(0).velocity[0].y(), 0) << "the event of step 3 came after the target";
  stepper->set_motor_velocity(0, 0, 0, 1);
  advance(*stepper, 20);
  expect_rate(stepper->state(0), true, 5 * 0.2);
}

TEST_P(Motors, keep_their_targets_where_the_world_is_put_into_another_state) {
  Model model = driven_box(JointKind::slider, {0, 5});
  model.events.push_back(motor_event(40, {0, 1}));
  const auto stepper = start(settings(), model);
  advance(*stepper, 50);
  stepper->set_motor_velocity(0, 0, 0, 10);
  advance(*stepper, 10);
  expect_rate(stepper->state(0), true, 1 * 0.1);  // the event's 1 N
  stepper->set_state(0, initial_state(model), 0);
  advance(*stepper, 10);
  expect_rate(stepper->state(0), true, 5 * 0.1);  // the model's 5 N
  stepper->set_state(0, initial_state(model), 45);
  advance(*stepper, 10);
  expect_rate(stepper->state(0), true, 1 * 0.1);
}

TEST_P(Motors, are_those_of_one_world) {
  const Model model = support::crash();
  int joint = 0;
  while (!model.joints[joint].motors[0].active()) ++joint;
  const auto lone = start(settings(), model), together = start(settings(), model, 5);
  for (const auto& [stepper, world] : {std::pair{lone.get(), 0}, {together.get(), 3}}) {
    advance(*stepper, 3);
    stepper->set_motor_velocity(world, joint, 0, 6);
    advance(*stepper, 10);
  }
  if (settings().kind != StepperKind::quick) {  // quick draws the order of its rows for each world
    EXPECT_EQ(hash_of(*together, 3), hash_of(*lone));
  }
  EXPECT_NE(hash_of(*together, 3), hash_of(*together, 2));
  const auto without = start(settings(), model, 5);
  advance(*without, 13);
  for (const int world : {0, 1, 2, 4}) EXPECT_EQ(hash_of(*together, world), hash_of(*without, world));
}

TEST_P(Motors, wake_what_they_drive_if_they_aim_elsewhere) {
  Model model = support::pendulum(1, 0);
  model.joints[0].motors[0] = {0, 1000};
  model.effects["sleeping"] = true;
  const auto stepper = start(settings(), model);
  advance(*stepper, 80);
  ASSERT_TRUE(stepper->state(0).rest[0].asleep()) << "it hangs straight down";
  stepper->set_motor_velocity(0, 0, 0, 0);
  EXPECT_TRUE(stepper->state(0).rest[0].asleep()) << "that is where it aims";
  stepper->set_motor_velocity(0, 0, 0, 2);
  EXPECT_FALSE(stepper->state(0).rest[0].asleep());
  advance(*stepper, 1);
  EXPECT_GT(stepper->state(0).angular_velocity[0].norm(), 1) << "driven at 2 rad/s";
}

TEST_P(Motors, a_world_that_is_put_back_with_its_targets_goes_on_with_the_same_bits) {
  Model model = driven_box(JointKind::hinge, {0.01, 5});
  model.effects["sleeping"] = true;
  const auto whole = start(settings(), model);
  whole->set_motor_velocity(0, 0, 0, 1);
  advance(*whole, 10);
  whole->set_motor_velocity(0, 0, 0, 0);  // so that the body sleeps, with a target other than its model's
  advance(*whole, 100);
  ASSERT_TRUE(whole->state(0).rest[0].asleep());
  const State saved = whole->state(0);
  const auto again = start(settings(), model);
  again->set_motor_velocity(0, 0, 0, 0);
  again->set_state(0, saved, 110);
  EXPECT_TRUE(again->state(0).rest[0].asleep());
  for (const auto& stepper : {whole.get(), again.get()}) {
    advance(*stepper, 5);
    EXPECT_EQ(hash_of(*stepper), model::hash(saved));
    stepper->set_motor_velocity(0, 0, 0, 3);
    advance(*stepper, 7);
  }
  EXPECT_EQ(hash_of(*again), hash_of(*whole));
}

TEST_P(Motors, are_refused_where_there_are_none) {
  Model model = driven_box(JointKind::hinge, {0, 5});
  support::add_solid(model, 0, "free", model::Shape::box, {1, 1, 1}, 1, {5, 0, 1});
  support::add_joint(model, JointKind::hinge, 1, model::no_body, {5, 0, 1}, Vec3::UnitY());
  model.joints[1].name = "loose";
  const auto stepper = start(settings(), model);
  const auto message = [&](int joint, int axis, double velocity) -> std::string {
    try {
      stepper->set_motor_velocity(0, joint, axis, velocity);
    } catch (const core::InputError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(message(1, 0, 1),
            "joint 'loose' has no motor on axis 1 to aim; give it one with a max_force in the scene");
  EXPECT_NE(message(0, 1, 1), "");
  EXPECT_NE(message(0, 2, 1), "");
  EXPECT_NE(message(2, 0, 1), "");
  EXPECT_NE(message(-1, 0, 1), "");
  EXPECT_NE(message(0, 0, std::numeric_limits<double>::quiet_NaN()), "");
  EXPECT_EQ(message(0, 0, 1), "");
}

}  // namespace
}  // namespace pbmpi::solver
