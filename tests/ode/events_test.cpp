#include <cmath>

#include <gtest/gtest.h>

#include "core/error.h"
#include "ode/ode_stepper.h"
#include "simulation.h"
#include "stepping/stepper_traits.h"
#include "support/models.h"

namespace pbmpi::ode {
namespace {

using model::Event;
using model::EventKind;
using model::JointKind;
using model::Model;
using model::Shape;
using model::Vec3;

const stepping::StepperSettings fine = [] {
  stepping::StepperSettings settings = default_settings(stepping::StepperKind::quick);
  settings.dt_s = 0.002;
  settings.iterations = 100;
  return settings;
}();

Event event_at(std::int64_t step, EventKind kind) {
  Event event;
  event.step = step;
  event.kind = kind;
  event.joint = event.kind == EventKind::launch ? -1 : 0;
  event.body = event.kind == EventKind::launch ? 0 : model::no_body;
  return event;
}

TEST(Events, of_kind_launch_set_the_velocity_at_their_step) {
  Model model = support::free_box();
  model.gravity.setZero();
  model.bodies[0].velocity = model.bodies[0].angular_velocity = Vec3::Zero();
  Event launch = event_at(10, EventKind::launch);
  launch.velocity = {5, 0, 0};
  launch.angular_velocity = {0, 0, 1};
  model.events.push_back(launch);
  Simulation simulation(model, fine);
  simulation.advance(10);  // steps 0 to 9
  EXPECT_EQ(simulation.state().velocity[0], Vec3::Zero());
  simulation.advance(1);
  EXPECT_EQ(simulation.state().velocity[0], Vec3(5, 0, 0));
  EXPECT_NEAR(simulation.state().position[0].x(), 5 * fine.dt_s, 1e-12);
  EXPECT_GT(simulation.state().angular_velocity[0].norm(), 0.9);
}

/// A heavy chassis with one wheel beside it that turns about y and steers about z; no gravity.
Model steered_wheel() {
  Model model;
  model.gravity.setZero();
  const int actor = support::add_actor(model, "car");
  support::add_solid(model, actor, "chassis", Shape::box, {1, 1, 1}, 1e5, {0, 0, 0});
  support::add_solid(model, actor, "wheel", Shape::sphere, {0.3, 0, 0}, 10, {0, 1, 0});
  support::add_joint(model, JointKind::hinge2, 0, 1, {0, 1, 0}, Vec3::UnitZ(), Vec3::UnitY());
  model.joints[0].limits[0] = {0, 0};
  return model;
}

/// Angle of the wheel's axle about z, from y [rad].
double steering_angle(const Simulation& simulation) {
  const Vec3 axle = simulation.direction(1, Vec3::UnitY());
  return std::atan2(-axle.x(), axle.y());
}

TEST(Events, of_kind_steer_turn_the_wheel_and_hold_it) {
  Model model = steered_wheel();
  for (const auto& [step, angle] : {std::pair{5, 0.4}, {500, -0.2}}) {
    Event steer = event_at(step, EventKind::steer);
    steer.angle = angle;
    model.events.push_back(steer);
  }
  Simulation simulation(model, fine);
  simulation.advance(5);
  EXPECT_NEAR(steering_angle(simulation), 0, 1e-9);
  simulation.advance(495);
  const double first = steering_angle(simulation);
  // ERP removes 20 % of the error in each step: after 495 steps only the iterations' residual is left.
  EXPECT_NEAR(std::abs(first), 0.4, 1e-3);
  simulation.advance(500);
  EXPECT_NEAR(steering_angle(simulation), -first / 2, 1e-3);
}

TEST(Events, of_kind_motor_hold_until_the_next) {
  Model model = steered_wheel();
  for (const auto& [step, speed] : {std::pair{0, 3.0}, {200, -1.0}}) {
    Event motor = event_at(step, EventKind::motor);
    motor.axis = 1;
    motor.motor = {speed, 100};
    model.events.push_back(motor);
  }
  Simulation simulation(model, fine);
  const auto spin = [&] { return simulation.state().angular_velocity[1].y(); };
  simulation.advance(200);
  const double first = spin();
  EXPECT_NEAR(std::abs(first), 3, 1e-3);  // the chassis turns back by 1e-5 of it
  simulation.advance(200);
  EXPECT_NEAR(spin(), -first / 3, 1e-3);
}

TEST(Events, on_an_axis_that_the_joint_lacks_are_refused) {
  const auto refused = [](const Event& event, JointKind kind) {
    Model model = support::chain(2);
    model.joints[0].kind = kind;
    model.events.push_back(event);
    const auto stepper = make_ode_stepper(fine, fail_on_warning);
    try {
      stepper->add(0, std::make_shared<Model>(model), model::initial_state(model), 0);
    } catch (const core::InputError&) {
      return true;
    }
    return false;
  };
  Event motor = event_at(1, EventKind::motor);
  EXPECT_TRUE(refused(motor, JointKind::ball));
  EXPECT_FALSE(refused(motor, JointKind::hinge));
  motor.axis = 1;
  EXPECT_TRUE(refused(motor, JointKind::hinge));
  EXPECT_FALSE(refused(motor, JointKind::universal));
  EXPECT_TRUE(refused(event_at(1, EventKind::steer), JointKind::fixed));
}

}  // namespace
}  // namespace pbmpi::ode
