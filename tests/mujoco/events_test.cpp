#include <cmath>

#include <gtest/gtest.h>

#include "core/error.h"
#include "simulation.h"
#include "support/models.h"

namespace pbmpi::mujoco {
namespace {

using model::Event;
using model::EventKind;
using model::JointKind;
using model::Model;
using model::Shape;
using model::Vec3;

Event event_at(std::int64_t step, EventKind kind) {
  Event event;
  event.step = step;
  event.kind = kind;
  event.joint = kind == EventKind::launch ? -1 : 0;
  event.body = kind == EventKind::launch ? 0 : model::no_body;
  return event;
}

TEST(MujocoEvents, of_kind_launch_set_pose_and_velocity_at_their_step) {
  Model model = support::free_box();
  model.gravity.setZero();
  model.bodies[0].velocity = model.bodies[0].angular_velocity = Vec3::Zero();
  Event launch = event_at(10, EventKind::launch);
  launch.velocity = {5, 0, 0};
  launch.pose = model::Pose{{1, 2, 3}, {}};
  model.events.push_back(launch);
  Simulation simulation(model);
  simulation.advance(10);  // steps 0 to 9
  EXPECT_EQ(simulation.state().velocity[0], Vec3::Zero());
  simulation.advance(1);
  EXPECT_NEAR(simulation.state().velocity[0].x(), 5, 1e-12);
  EXPECT_LT((simulation.state().position[0] - Vec3(1 + 5 * 0.01, 2, 3)).norm(), 1e-12);
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

/// Direction of the wheel's axle, as an angle [rad] from y towards x.
double steering(const model::State& state) {
  const Vec3 axle = state.orientation[1].to_eigen() * Vec3::UnitY();
  return std::atan2(axle.x(), axle.y());
}

TEST(MujocoEvents, of_kind_steer_turn_a_wheel_as_in_ode) {
  Model model = steered_wheel();
  Event steer = event_at(5, EventKind::steer);
  steer.angle = 0.3;
  model.events.push_back(steer);
  Simulation simulation(model);
  Simulation reference = Simulation::by_ode(model);
  simulation.advance(5);
  EXPECT_NEAR(steering(simulation.state()), 0, 1e-6);
  simulation.advance(95);
  reference.advance(100);
  EXPECT_NEAR(std::abs(steering(simulation.state())), 0.3, 1e-3);
  EXPECT_NEAR(steering(simulation.state()), steering(reference.state()), 1e-2) << "to the same side";
}

TEST(MujocoEvents, of_kind_motor_replace_a_motor_and_aim_drives_it_elsewhere) {
  Model model = steered_wheel();
  Event motor = event_at(5, EventKind::motor);
  motor.axis = 1;
  motor.motor = {4, 1000};
  model.events.push_back(motor);
  Simulation simulation(model);
  Simulation reference = Simulation::by_ode(model);
  simulation.advance(5);
  EXPECT_NEAR(simulation.state().angular_velocity[1].norm(), 0, 1e-9);
  simulation.advance(30);
  reference.advance(35);
  EXPECT_NEAR(std::abs(simulation.state().angular_velocity[1].y()), 4, 0.02);
  EXPECT_NEAR(simulation.state().angular_velocity[1].y(), reference.state().angular_velocity[1].y(), 0.02);
  simulation.stepper().set_motor_velocity(0, 0, 1, 1);
  simulation.advance(30);
  EXPECT_NEAR(std::abs(simulation.state().angular_velocity[1].y()), 1, 0.02);
}

TEST(MujocoEvents, that_drive_an_axis_which_is_not_there_are_refused) {
  Model model = support::chain(1);
  Event motor = event_at(5, EventKind::motor);
  motor.motor = {1, 1};
  model.events.push_back(motor);
  const auto make = [&] { return Simulation(model); };
  EXPECT_THROW(make(), core::InputError);
}

TEST(MujocoEvents, of_earlier_steps_hold_where_a_world_is_put_back) {
  Model model = steered_wheel();
  Event steer = event_at(3, EventKind::steer);
  steer.angle = 0.3;
  model.events.push_back(steer);
  Event motor = event_at(4, EventKind::motor);
  motor.axis = 1;
  motor.motor = {4, 1000};
  model.events.push_back(motor);
  EXPECT_EQ(hash_after(model, 20), hash_after_restore(model, 10, 10));
  EXPECT_EQ(hash_after(model, 20), hash_after_restore(model, 4, 16)) << "in the midst of the events";
}

}  // namespace
}  // namespace pbmpi::mujoco
