// This file is long because it compares every kind of joint with its analytic motion, one after the other,
// with shared models.
#include "ode/objects/joints.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "core/error.h"
#include "model/joint_gap.h"
#include "ode/ode_stepper.h"
#include "simulation.h"
#include "stepping/stepper_traits.h"
#include "support/models.h"

namespace pbmpi::ode {
namespace {

using model::JointKind;
using model::Model;
using model::Shape;
using model::Vec3;
using stepping::StepperKind;

const stepping::StepperSettings fine = [] {
  stepping::StepperSettings settings = default_settings(stepping::StepperKind::quick);
  settings.dt_s = 0.002;
  settings.iterations = 100;
  return settings;
}();

/// A heavy box a and a light box b beside it, free of gravity, joined in the middle between them.
Model joined(JointKind kind, const Vec3& axis1, const Vec3& axis2) {
  Model model;
  model.gravity.setZero();
  const int actor = support::add_actor(model, "pair");
  support::add_solid(model, actor, "a", Shape::box, {1, 1, 1}, 5, {0, 0, 0});
  support::add_solid(model, actor, "b", Shape::box, {0.6, 0.5, 0.4}, 2, {1.2, 0, 0});
  support::add_joint(model, kind, 0, 1, {0.7, 0, 0}, axis1, axis2);
  model.bodies[0].angular_velocity = {0.3, 0.2, -0.4};
  model.bodies[1].velocity = {0.1, 0.4, 0.3};
  model.bodies[1].angular_velocity = {-0.8, 0.5, 1.1};
  return model;
}

/// The rotation of b relative to a.
Eigen::Quaterniond relative_turn(const Simulation& simulation) {
  const auto& turn = simulation.state().orientation;
  return turn[0].to_eigen().conjugate() * turn[1].to_eigen();
}

/// Tolerances of the constraints: rad and m. The error of the linearised step is some (omega h)^2 = 1e-5 per
/// step, of which ERP removes 20 % in each step.
constexpr double drift = 1e-3;

class EveryKind : public testing::TestWithParam<JointKind> {};
INSTANTIATE_TEST_SUITE_P(Joints, EveryKind,
                         testing::Values(JointKind::ball, JointKind::hinge, JointKind::slider,
                                         JointKind::universal, JointKind::fixed, JointKind::hinge2));

TEST_P(EveryKind, holds_its_anchors_together) {
  Simulation simulation(joined(GetParam(), Vec3::UnitZ(), Vec3::UnitX()), fine);
  for (int i = 0; i < 20; ++i) {
    simulation.advance(50);
    EXPECT_LT(simulation.observables().joint_gap_m, drift);
  }
}

TEST_P(EveryKind, has_the_rows_of_its_freedoms) {
  constexpr int rows[model::num_joint_kinds] = {3, 5, 5, 4, 6, 4};
  Simulation simulation(joined(GetParam(), Vec3::UnitZ(), Vec3::UnitX()), fine);
  simulation.advance(1);
  EXPECT_EQ(simulation.observables().rows, rows[static_cast<int>(GetParam())]);
}

TEST(Joints, of_kind_hinge_turn_about_their_axis_only) {
  Simulation simulation(joined(JointKind::hinge, Vec3::UnitZ(), Vec3::UnitX()), fine);
  simulation.advance(500);
  const Vec3 axis = relative_turn(simulation) * Vec3::UnitZ();
  EXPECT_LT(axis.cross(Vec3::UnitZ()).norm(), drift);
  EXPECT_GT(std::abs(Eigen::AngleAxisd(relative_turn(simulation)).angle()), 0.1);  // and they do turn
}

TEST(Joints, of_kind_slider_slide_without_turning) {
  Simulation simulation(joined(JointKind::slider, Vec3::UnitY(), Vec3::UnitX()), fine);
  simulation.advance(500);
  EXPECT_LT(Eigen::AngleAxisd(relative_turn(simulation)).angle(), drift);
  const auto& state = simulation.state();
  const Vec3 offset = state.orientation[0].to_eigen().conjugate() * (state.position[1] - state.position[0]);
  EXPECT_GT(std::abs(offset.y()), 0.05);
}

TEST(Joints, of_kind_universal_and_hinge2_keep_their_axes_square) {
  for (const JointKind kind : {JointKind::universal, JointKind::hinge2}) {
    Simulation simulation(joined(kind, Vec3::UnitZ(), Vec3::UnitX()), fine);
    simulation.advance(500);
    const Vec3 axis1 = simulation.direction(0, Vec3::UnitZ());
    const Vec3 axis2 = simulation.direction(1, Vec3::UnitX());
    EXPECT_NEAR(axis1.dot(axis2), 0, drift);
  }
}

TEST(Joints, of_kind_universal_take_any_two_axes) {
  const Vec3 axes[] = {Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ(), -Vec3::UnitX(), -Vec3::UnitY()};
  for (const Vec3& axis1 : axes) {
    for (const Vec3& axis2 : axes) {
      if (std::abs(axis1.dot(axis2)) > 0.5) continue;
      Simulation simulation(joined(JointKind::universal, axis1, axis2), fine);  // any message fails the test
      simulation.advance(100);
      EXPECT_NEAR(simulation.direction(0, axis1).dot(simulation.direction(1, axis2)), 0, drift);
    }
  }
}

TEST(Joints, of_kind_fixed_do_not_move) {
  Simulation simulation(joined(JointKind::fixed, Vec3::UnitZ(), Vec3::UnitX()), fine);
  simulation.advance(500);
  EXPECT_LT(Eigen::AngleAxisd(relative_turn(simulation)).angle(), drift);
}

TEST(Joints, to_the_world_hold_the_world_anchor) {
  for (const JointKind kind :
       {JointKind::ball, JointKind::hinge, JointKind::slider, JointKind::universal, JointKind::fixed}) {
    Model model = support::free_box();
    support::add_joint(model, kind, 0, model::no_body, {0, 0, 10.3}, Vec3::UnitX(), Vec3::UnitY());
    Simulation simulation(model, fine);
    simulation.advance(250);
    EXPECT_LT(simulation.observables().joint_gap_m, drift) << static_cast<int>(kind);
    EXPECT_LT(std::abs(simulation.state().position[0].z() - 10), 0.7);  // it would have fallen 1.2 m
  }
}

TEST(Joints, keep_each_bodys_own_anchor_over_a_gap_of_the_start) {
  Model model = joined(JointKind::ball, Vec3::UnitZ(), Vec3::UnitX());
  model.joints[0].anchor_b.y() += 0.2;
  for (model::Body& body : model.bodies) body.velocity = body.angular_velocity = Vec3::Zero();
  EXPECT_NEAR(model::max_joint_gap(model, model::initial_state(model)), 0.2, 1e-12);
  Simulation simulation(model, fine);
  simulation.advance(200);
  EXPECT_LT(simulation.observables().joint_gap_m, drift);  // ERP has pulled them together
  EXPECT_GT((simulation.state().position[1] - Vec3(1.2, 0, 0)).norm(), 0.05);
}

/// A body that rests against a stop crosses it back and forth by rounding, so the row comes and goes.
int most_rows(Simulation& simulation, int num_steps) {
  int most = 0;
  for (int step = 0; step < num_steps; ++step) {
    simulation.advance(1);
    most = std::max(most, simulation.observables().rows);
  }
  return most;
}

TEST(Joints, stop_at_their_limits) {
  for (const double side : {-1.0, 1.0}) {
    Model model = support::pendulum(1, side * 1.2);
    model.joints[0].limits[0] = {-0.7, 0.7};  // relative to the start: the hinge may swing 0.7 rad from there
    Simulation simulation(model, fine);
    simulation.advance(2500);
    EXPECT_EQ(most_rows(simulation, 50), 6);  // 5 for the hinge, 1 for the stop
    const auto& position = simulation.state().position[0];
    const double angle = std::atan2(position.x(), -position.z());
    EXPECT_NEAR(angle, side * (1.2 - 0.7), 0.01);  // a stop gives by g h^2 / (ERP L) = 0.2 mrad
  }
}

TEST(Joints, of_kind_slider_stop_at_their_limits) {
  Model model = support::free_box();
  model.bodies[0].velocity = model.bodies[0].angular_velocity = Vec3::Zero();
  support::add_joint(model, JointKind::slider, 0, model::no_body, {0, 0, 10}, Vec3::UnitZ());
  model.joints[0].limits[0] = {-0.5, 0.5};
  Simulation simulation(model, fine);
  simulation.advance(1000);
  EXPECT_EQ(most_rows(simulation, 50), 6);
  EXPECT_NEAR(simulation.state().position[0].z(), 9.5, 0.001);  // a stop gives by g h^2 / ERP = 0.2 mm
}

TEST(Joints, of_kind_universal_stop_at_the_limits_of_both_axes) {
  for (const int axis : {0, 1}) {
    Model model = joined(JointKind::universal, Vec3::UnitZ(), Vec3::UnitX());
    model.joints[0].limits[axis] = {-0.2, 0.2};
    Simulation simulation(model, fine);
    double widest = 0;
    for (int i = 0; i < 200; ++i) {
      simulation.advance(5);
      const Vec3 axis2 = relative_turn(simulation) * Vec3::UnitX();  // turns about a's z with axis 1
      const Vec3 axis1 =
          relative_turn(simulation).conjugate() * Vec3::UnitZ();  // turns about b's x with axis 2
      widest = std::max(widest, axis == 0 ? std::abs(std::atan2(axis2.y(), axis2.x()))
                                          : std::abs(std::atan2(axis1.y(), axis1.z())));
    }
    EXPECT_GT(widest, 0.19);
    EXPECT_LT(widest, 0.22);  // the bodies reach the stop with up to 2 rad/s: some 5 mrad per step
  }
}

TEST(Joints, drive_their_motors_to_speed) {
  struct Case {
    JointKind kind;
    int axis;
  };
  for (const Case& c : {Case{JointKind::hinge, 0}, Case{JointKind::universal, 0},
                        Case{JointKind::universal, 1}, Case{JointKind::hinge2, 1}}) {
    Model model = joined(c.kind, Vec3::UnitZ(), Vec3::UnitX());
    for (model::Body& body : model.bodies) body.velocity = body.angular_velocity = Vec3::Zero();
    model.joints[0].motors[c.axis] = {2, 100};
    Simulation simulation(model, fine);
    simulation.advance(50);
    const auto& state = simulation.state();
    const Vec3 axis =
        c.axis == 0 ? simulation.direction(0, Vec3::UnitZ()) : simulation.direction(1, Vec3::UnitX());
    const double speed = (state.angular_velocity[1] - state.angular_velocity[0]).dot(axis);
    // The sign is ODE's convention: which body counts as turning differs from kind to kind. 1 % for the other
    // axis' motion.
    EXPECT_NEAR(std::abs(speed), 2, 0.02) << static_cast<int>(c.kind) << " axis " << c.axis;
  }
}

TEST(Joints, of_kind_slider_drive_their_motors_to_speed) {
  Model model = joined(JointKind::slider, Vec3::UnitX(), Vec3::UnitX());
  for (model::Body& body : model.bodies) body.velocity = body.angular_velocity = Vec3::Zero();
  model.joints[0].motors[0] = {0.5, 100};
  Simulation simulation(model, fine);
  simulation.advance(50);
  const auto& state = simulation.state();
  EXPECT_NEAR(std::abs((state.velocity[1] - state.velocity[0]).x()), 0.5, 1e-6);  // one row, solved exactly
}

TEST(Joints, hold_a_pose_with_a_motor_of_speed_zero_up_to_its_force) {
  for (const auto& [torque, holds] : {std::pair{10.0, true}, {3.0, false}}) {
    Model model = support::pendulum(1, std::numbers::pi / 6);  // m g L sin(30 deg) = 4.9 N m
    model.joints[0].motors[0] = {0, torque};
    Simulation simulation(model, fine);
    simulation.advance(250);
    const double moved = (simulation.state().position[0] - model.bodies[0].pose.position).norm();
    EXPECT_EQ(moved < 1e-3, holds) << torque << " N m: " << moved << " m";
  }
}

// A pendulum under gravity: dry friction keeps it where it is pushed, a hold rate brings it back.
TEST(Joints, turn_back_to_the_pose_that_a_motor_holds) {
  for (const StepperKind kind : {StepperKind::quick, StepperKind::direct}) {
    for (const auto& [rate, left] : {std::pair{0.0, 1.0}, {4.0, std::exp(-4 * 0.5)}}) {
      Model model = support::pendulum(1, 0);
      model.joints[0].motors[0] = {0, 100, rate};
      model::State pushed = model::initial_state(model);
      const Eigen::Quaterniond turn(Eigen::AngleAxisd(0.2, Vec3::UnitY()));
      pushed.position[0] = turn * pushed.position[0];
      pushed.orientation[0] = {turn.w(), turn.x(), turn.y(), turn.z()};
      stepping::StepperSettings settings = fine;
      settings.kind = kind;
      const auto stepper = make_ode_stepper(settings, fail_on_warning);
      stepper->add(0, std::make_shared<Model>(model), pushed, 0);
      core::PhaseTimes times;
      stepper->advance(250, times);  // 0.5 s
      const Vec3& position = stepper->state(0).position[0];
      const double angle = std::abs(std::atan2(position.x(), position.z()));
      const double from_rest = std::min(angle, std::numbers::pi - angle);
      // (1 - 4 x 0.002)^250 is 0.8 % below exp(-2).
      EXPECT_NEAR(from_rest, 0.2 * left, 0.002) << rate;
    }
  }
}

TEST(Joints, hold_what_an_event_says_from_then_on) {
  Model model = support::pendulum(1, 0);
  model.joints[0].motors[0] = {0.5, 100, 0};
  model::Event hold;
  hold.step = 100;
  hold.kind = model::EventKind::motor;
  hold.joint = 0;
  hold.motor = {0, 100, 20};
  model.events.push_back(hold);
  Simulation simulation(model, fine);
  simulation.advance(100);
  const auto moved = [&] { return (simulation.state().position[0] - model.bodies[0].pose.position).norm(); };
  EXPECT_GT(moved(), 0.05);  // 0.5 rad/s for 0.2 s
  simulation.advance(400);
  EXPECT_LT(moved(), 1e-3);
}

/// A chassis of 100 kg over a wheel that a fixed joint holds to the world.
Model car_corner() {
  Model model;
  const int actor = support::add_actor(model, "corner");
  const Vec3 hub(0, 0, 1);
  support::add_solid(model, actor, "chassis", Shape::box, {1, 1, 1}, 100, hub);
  support::add_solid(model, actor, "wheel", Shape::sphere, {0.3, 0, 0}, 20, hub);
  support::add_joint(model, JointKind::fixed, 1, model::no_body, hub);
  const int hinge2 = support::add_joint(model, JointKind::hinge2, 0, 1, hub, Vec3::UnitZ(), Vec3::UnitY());
  model.joints[hinge2].suspension = {20000, 2000};
  model.joints[hinge2].limits[0] = {0, 0};
  return model;
}

TEST(Joints, of_kind_hinge2_spring_by_the_weight_over_the_stiffness) {
  Simulation simulation(car_corner(), fine);
  simulation.advance(2000);
  const double sag = 1 - simulation.state().position[0].z();
  EXPECT_NEAR(sag, 100 * 9.81 / 20000,
              1e-4);  // at rest ERP and CFM represent the spring exactly; the sweeps do not converge exactly
}

TEST(Joints, of_kind_hinge2_damp_their_spring) {
  Model model = car_corner();
  model.joints[1].suspension = {20000, 2 * std::sqrt(20000.0 * 100)};  // critical: no overshoot
  Simulation simulation(model, fine);
  double lowest = 1;
  for (int i = 0; i < 500; ++i) {
    simulation.advance(2);
    lowest = std::min(lowest, simulation.state().position[0].z());
  }
  EXPECT_GT(lowest, 1 - 1.02 * 100 * 9.81 / 20000);
}

TEST(Joints, of_kind_hinge2_without_stiffness_are_rigid) {
  Model model = car_corner();
  model.joints[1].suspension = {};
  Simulation simulation(model, fine);
  simulation.advance(500);
  EXPECT_NEAR(simulation.state().position[0].z(), 1, drift);
}

/// The message with which a stepper refuses the model; empty if it accepts it.
std::string refusal(const Model& model) {
  const auto stepper = make_ode_stepper(fine, fail_on_warning);
  try {
    stepper->add(0, std::make_shared<Model>(model), model::initial_state(model), 0);
  } catch (const core::InputError& error) {
    return error.what();
  }
  return "";
}

TEST(Joints, that_ode_does_not_have_are_refused) {
  Model ball = joined(JointKind::ball, Vec3::UnitZ(), Vec3::UnitX());
  EXPECT_EQ(refusal(ball), "");
  ball.joints[0].motors[0].max_force = 1;
  EXPECT_NE(refusal(ball).find("joint 'joint0': it has a motor on axis 1"), std::string::npos);
  Model hinge = joined(JointKind::hinge, Vec3::UnitZ(), Vec3::UnitX());
  hinge.joints[0].limits[1].low = 0;
  EXPECT_NE(refusal(hinge).find("limit on axis 2"), std::string::npos);
  Model hinge2 = joined(JointKind::hinge2, Vec3::UnitZ(), Vec3::UnitX());
  hinge2.joints[0].limits[1].low = 0;
  EXPECT_NE(refusal(hinge2).find("limit on axis 2"), std::string::npos);
  hinge2.joints[0].limits[1] = {};
  hinge2.joints[0].body_b = model::no_body;
  EXPECT_NE(refusal(hinge2).find("two bodies"), std::string::npos);
  const Model parallel = joined(JointKind::universal, Vec3::UnitZ(), Vec3::UnitZ());
  EXPECT_NE(refusal(parallel).find("two axes are parallel"), std::string::npos);
}

}  // namespace
}  // namespace pbmpi::ode
