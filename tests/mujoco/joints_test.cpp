#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "model/joint_gap.h"
#include "simulation.h"
#include "support/models.h"

namespace pbmpi::mujoco {
namespace {

using model::JointKind;
using model::Model;
using model::Shape;
using model::Vec3;

/// A rod that hangs on the world at its end, by a joint of this kind; axis 1 is y, axis 2 x.
Model hanging_rod(JointKind kind) {
  Model model;
  const int actor = support::add_actor(model, "rod");
  support::add_solid(model, actor, "rod", Shape::box, {0.1, 0.1, 1}, 1, {0, 0, -0.5});
  support::add_joint(model, kind, 0, model::no_body, Vec3::Zero(), Vec3::UnitY(), Vec3::UnitX());
  return model;
}

/// Angle [rad] of the rod about y.
double angle_of(const model::State& state) {
  const model::Quat& q = state.orientation[0];
  return 2 * std::atan2(q.y, q.w);
}

TEST(MujocoJoints, stop_at_their_limits) {
  Model model = hanging_rod(JointKind::hinge);
  model.joints[0].limits[0] = {-0.3, 0.2};
  for (const double speed : {2.0, -2.0}) {
    model.bodies[0].angular_velocity = {0, speed, 0};
    model.bodies[0].velocity = {-0.5 * speed, 0, 0};
    model.gravity = {speed < 0 ? 9.81 : -9.81, 0, 0};  // presses it against the limit
    Simulation simulation(model);
    simulation.advance(200);
    EXPECT_NEAR(angle_of(simulation.state()), speed > 0 ? 0.2 : -0.3, 1e-3);
  }
}

TEST(MujocoJoints, are_driven_by_motors_at_their_speed) {
  Model model = hanging_rod(JointKind::hinge);
  model.gravity.setZero();
  model.joints[0].motors[0] = {3, 100};
  Simulation simulation(model);
  simulation.advance(20);
  EXPECT_NEAR(simulation.state().angular_velocity[0].y(), 3, 1e-2);
}

TEST(MujocoJoints, are_driven_by_motors_with_no_more_than_their_force) {
  Model model = hanging_rod(JointKind::hinge);
  model.gravity.setZero();
  model.joints[0].motors[0] = {100, 2};
  Simulation simulation(model);
  simulation.advance(50);
  const double inertia = 1. / 12 * (0.01 + 1) + 0.25;
  EXPECT_NEAR(simulation.state().angular_velocity[0].y(), 0.5 * 2 / inertia, 1e-6);
}

TEST(MujocoJoints, hold_a_pose_with_a_hold_rate) {
  Model model = hanging_rod(JointKind::hinge);
  model.gravity.setZero();
  model.bodies[0].angular_velocity = {0, 2, 0};
  model.bodies[0].velocity = {-1, 0, 0};
  model.joints[0].motors[0] = {0, 1, 5};
  Simulation simulation(model);
  simulation.advance(300);
  EXPECT_NEAR(angle_of(simulation.state()), 0, 1e-3);
}

/// The largest distance [m] of a body from its position in ODE after 0.3 s of small steps.
double distance_from_ode(const Model& model) {
  const double dt_s = 5e-4;
  Simulation simulation(model, settings_with(dt_s));
  Simulation reference = Simulation::by_ode(model, dt_s);
  simulation.advance(600);
  reference.advance(600);
  double distance = 0;
  for (int body = 0; body < model.num_bodies(); ++body) {
    const model::State &ours = simulation.state(), &theirs = reference.state();
    const Eigen::Quaterniond turn = ours.orientation[body].to_eigen();
    distance = std::max(distance, (ours.position[body] - theirs.position[body]).norm());
    distance = std::max(distance, turn.angularDistance(theirs.orientation[body].to_eigen()));
  }
  EXPECT_LT(simulation.observables().joint_gap_m, 1e-12);
  return distance;
}

/// Two bars, either of which may be the joint's first body; without gravity, so that joint and motors do all
/// the work.
Model two_bars(JointKind kind, bool swapped) {
  Model model;
  model.gravity.setZero();
  const int actor = support::add_actor(model, "bars");
  support::add_solid(model, actor, "left", Shape::box, {0.6, 0.1, 0.2}, 1, {-0.3, 0, 0});
  support::add_solid(model, actor, "right", Shape::box, {0.6, 0.1, 0.2}, 2, {0.3, 0, 0},
                     support::rotation(Vec3::UnitX(), 0.4));
  support::add_joint(model, kind, swapped ? 1 : 0, swapped ? 0 : 1, Vec3::Zero(), Vec3::UnitZ(),
                     Vec3::UnitX());
  model.bodies[0].angular_velocity = {0.5, 0, 0.3};
  return model;
}

class EveryJoint : public testing::TestWithParam<std::tuple<JointKind, bool>> {};

INSTANTIATE_TEST_SUITE_P(Kinds, EveryJoint,
                         testing::Combine(testing::Values(JointKind::ball, JointKind::hinge,
                                                          JointKind::slider, JointKind::universal,
                                                          JointKind::fixed, JointKind::hinge2),
                                          testing::Bool()));

// Both integrate to first order in the step; ODE applies the initial velocities, which the joint does not
// allow, a step later than MuJoCo's coordinates do. For motions of 0.3 m and 1 rad this leaves a few
// thousandths.
constexpr double near = 0.01;

TEST_P(EveryJoint, moves_as_in_ode) {
  const auto [kind, swapped] = GetParam();
  Model model = two_bars(kind, swapped);
  for (model::Body& body : model.bodies) {  // a motion that every joint allows
    body.angular_velocity = {0.3, 0.4, 0.5};
    body.velocity = body.angular_velocity.cross(body.pose.position);
  }
  EXPECT_LT(distance_from_ode(model), near);
}

TEST_P(EveryJoint, is_driven_in_the_direction_of_ode) {
  const auto [kind, swapped] = GetParam();
  Model model = two_bars(kind, swapped);
  for (model::Body& body : model.bodies) body.angular_velocity.setZero();
  if (kind == JointKind::ball || kind == JointKind::fixed) return;  // without axes
  model.joints[0].motors[0] = {0.8, 50};
  if (kind == JointKind::universal || kind == JointKind::hinge2) model.joints[0].motors[1] = {-0.6, 50};
  EXPECT_LT(distance_from_ode(model), near);
}

TEST_P(EveryJoint, is_limited_as_in_ode) {
  const auto [kind, swapped] = GetParam();
  Model model = two_bars(kind, swapped);
  for (model::Body& body : model.bodies) body.angular_velocity.setZero();
  if (kind == JointKind::ball || kind == JointKind::fixed) return;  // without axes
  model.joints[0].motors[0] = {0.8, 50};
  model.joints[0].limits[0] = {-0.2, 0.1};
  if (kind == JointKind::universal) {
    model.joints[0].motors[1] = {-0.6, 50};
    model.joints[0].limits[1] = {-0.05, 0.2};
  }
  EXPECT_LT(distance_from_ode(model), near);
}

/// A free chassis above a wheel on a suspension.
TEST(MujocoJoints, spring_with_the_suspension_of_ode) {
  for (const bool wheel_first : {false, true}) {
    Model model;
    const int actor = support::add_actor(model, "car");
    support::add_ground(model);
    const auto add_wheel = [&] {
      return support::add_solid(model, actor, "wheel", Shape::sphere, {0.3, 0, 0}, 10, {0, 0, 0.3});
    };
    const auto add_chassis = [&] {
      return support::add_solid(model, actor, "chassis", Shape::box, {1, 1, 0.3}, 200, {0, 0, 0.8});
    };
    const int first = wheel_first ? add_wheel() : add_chassis();
    const int second = wheel_first ? add_chassis() : add_wheel();
    const int chassis = wheel_first ? second : first, wheel = wheel_first ? first : second;
    support::add_joint(model, JointKind::hinge2, chassis, wheel, {0, 0, 0.3}, Vec3::UnitZ(), Vec3::UnitY());
    model.joints[0].suspension = {20000, 1000};
    EXPECT_LT(distance_from_ode(model), near);
    Simulation simulation(model);
    simulation.advance(300);
    EXPECT_NEAR(simulation.state().position[chassis].z(), 0.8 - 200 * 9.81 / 20000, 1e-3)
        << "sags by its weight";
  }
}

}  // namespace
}  // namespace pbmpi::mujoco
