// Every kind of joint on its own, and against ODE's: which direction of an axis is positive is ODE's
// convention.
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "core/error.h"
#include "model/joint_gap.h"
#include "model/joint_traits.h"
#include "ode/ode_stepper.h"
#include "simulation.h"
#include "support/models.h"

namespace pbmpi::bullet {
namespace {

using model::JointKind;
using model::Model;
using model::Shape;
using model::Vec3;

const stepping::StepperSettings fine = settings_of(0.002, 100);

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

Model at_rest(Model model) {
  for (model::Body& body : model.bodies) body.velocity = body.angular_velocity = Vec3::Zero();
  return model;
}

/// The rotation of b relative to a.
Eigen::Quaterniond relative_turn(const model::State& state) {
  return state.orientation[0].to_eigen().conjugate() * state.orientation[1].to_eigen();
}

model::State after_ode(const Model& model, int num_steps) {
  stepping::StepperSettings settings = fine;
  settings.kind = stepping::StepperKind::quick;
  settings.iterations = 200;
  const auto stepper = ode::make_ode_stepper(settings);
  stepper->add(0, std::make_shared<Model>(model), model::initial_state(model), 0);
  core::PhaseTimes times;
  stepper->advance(num_steps, times);
  return stepper->state(0);
}

/// Tolerances of the constraints: rad and m. The error of the linearised step is some (omega h)^2 = 1e-5 per
/// step, of which ERP removes 20 % in each step.
constexpr double drift = 1e-3;

class EveryKind : public testing::TestWithParam<JointKind> {};
INSTANTIATE_TEST_SUITE_P(Joints, EveryKind,
                         testing::Values(JointKind::ball, JointKind::hinge, JointKind::slider,
                                         JointKind::universal, JointKind::fixed, JointKind::hinge2),
                         [](const auto& kind) { return std::string(model::traits_of(kind.param).name); });

TEST_P(EveryKind, holds_its_anchors_together) {
  Simulation simulation(joined(GetParam(), Vec3::UnitZ(), Vec3::UnitX()), fine);
  for (int i = 0; i < 20; ++i) {
    simulation.advance(50);
    EXPECT_LT(simulation.observables().joint_gap_m, drift);
  }
}

TEST_P(EveryKind, has_the_rows_of_its_freedoms) {
  Simulation simulation(joined(GetParam(), Vec3::UnitZ(), Vec3::UnitX()), fine);
  simulation.advance(1);
  EXPECT_EQ(simulation.observables().rows, model::traits_of(GetParam()).held_rows());
}

TEST_P(EveryKind, moves_as_odes_does) {
  const Model model = joined(GetParam(), Vec3::UnitZ(), Vec3::UnitX());
  Simulation simulation(model, fine);
  simulation.advance(100);
  const model::State ode = after_ode(model, 100);
  // 0.2 s at up to 1.5 rad/s and 0.5 m/s; both steppers are of first order with h = 2 ms.
  for (int body = 0; body < 2; ++body) {
    EXPECT_LT((simulation.state().position[body] - ode.position[body]).norm(), 1e-3);
    EXPECT_LT((simulation.state().angular_velocity[body] - ode.angular_velocity[body]).norm(), 0.01);
  }
}

/// A rotated pair whose bodies have frames of their own.
TEST_P(EveryKind, moves_as_odes_does_where_nothing_lies_along_axes) {
  Model model = joined(GetParam(), Vec3::UnitZ(), Vec3::UnitX());
  const Vec3 axis1 = Vec3(1, 2, 3).normalized(), axis2 = Vec3(2, -1.2, 0.1).normalized();
  model.joints.clear();
  model.bodies[0].pose.orientation = support::rotation(Vec3(0, 1, 1).normalized(), 0.8);
  model.bodies[1].pose.orientation = support::rotation(Vec3(1, 0, 1).normalized(), -1.1);
  model.bodies[1].inertia(0, 1) = model.bodies[1].inertia(1, 0) = 0.02;
  support::add_joint(model, GetParam(), 0, 1, {0.7, 0, 0}, axis1, axis2);
  Simulation simulation(model, fine);
  simulation.advance(100);
  const model::State ode = after_ode(model, 100);
  for (int body = 0; body < 2; ++body) {
    EXPECT_LT((simulation.state().position[body] - ode.position[body]).norm(), 2e-3);
    EXPECT_LT((simulation.state().angular_velocity[body] - ode.angular_velocity[body]).norm(), 0.02);
  }
}

TEST(Joints, to_the_world_hold_the_world_anchor) {
  for (const JointKind kind :
       {JointKind::ball, JointKind::hinge, JointKind::slider, JointKind::universal, JointKind::fixed}) {
    Model model = support::free_box();
    support::add_joint(model, kind, 0, model::no_body, {0, 0, 10.3}, Vec3::UnitX(), Vec3::UnitY());
    Simulation simulation(model, fine);
    simulation.advance(250);
    EXPECT_LT(simulation.observables().joint_gap_m, 2 * drift) << static_cast<int>(kind);
    EXPECT_LT(std::abs(simulation.state().position[0].z() - 10), 0.7);  // it would have fallen 1.2 m
  }
}

TEST(Joints, keep_each_bodys_own_anchor_over_a_gap_of_the_start) {
  Model model = at_rest(joined(JointKind::ball, Vec3::UnitZ(), Vec3::UnitX()));
  model.joints[0].anchor_b.y() += 0.2;
  Simulation simulation(model, fine);
  simulation.advance(200);
  EXPECT_LT(simulation.observables().joint_gap_m, drift);  // ERP has pulled them together
  EXPECT_GT((simulation.state().position[1] - Vec3(1.2, 0, 0)).norm(), 0.05);
}

TEST(Joints, stop_at_their_limits) {
  for (const double side : {-1.0, 1.0}) {
    Model model = support::pendulum(1, side * 1.2);
    model.joints[0].limits[0] = {-0.7, 0.5};
    Simulation simulation(model, fine);
    simulation.advance(2500);
    EXPECT_EQ(simulation.observables().rows, 7);  // 5 of the hinge, 1 of each stop
    const model::State ode = after_ode(model, 2500);
    // A stop yields by g h^2 / (ERP L) = 0.2 mrad; which of the two stops it is follows from ODE's
    // convention.
    EXPECT_LT((simulation.state().position[0] - ode.position[0]).norm(), 0.01);
    EXPECT_LT(simulation.state().velocity[0].norm(), 0.01);
  }
}

TEST(Joints, of_kind_slider_stop_at_their_limits) {
  Model model = at_rest(support::free_box());
  support::add_joint(model, JointKind::slider, 0, model::no_body, {0, 0, 10}, Vec3::UnitZ());
  model.joints[0].limits[0] = {-0.5, 0.3};
  for (const double pull : {-9.81, 9.81}) {
    model.gravity = {0, 0, pull};
    Simulation simulation(model, fine);
    simulation.advance(1500);
    EXPECT_NEAR(simulation.state().position[0].z(), pull < 0 ? 9.5 : 10.3, 0.001);  // g h^2 / ERP = 0.2 mm
  }
}

TEST(Joints, of_kind_universal_stop_at_the_limits_of_both_axes) {
  for (const int axis : {0, 1}) {
    Model model = joined(JointKind::universal, Vec3::UnitZ(), Vec3::UnitX());
    model.joints[0].limits[static_cast<std::size_t>(axis)] = {-0.2, 0.2};
    Simulation simulation(model, fine);
    double widest = 0;
    for (int i = 0; i < 200; ++i) {
      simulation.advance(5);
      const Eigen::Quaterniond turn = relative_turn(simulation.state());
      const Vec3 axis2 = turn * Vec3::UnitX();              // turns about a's z with axis 1
      const Vec3 axis1 = turn.conjugate() * Vec3::UnitZ();  // turns about b's x with axis 2
      widest = std::max(widest, axis == 0 ? std::abs(std::atan2(axis2.y(), axis2.x()))
                                          : std::abs(std::atan2(axis1.y(), axis1.z())));
    }
    EXPECT_GT(widest, 0.19);
    EXPECT_LT(widest, 0.22);
  }
}

struct Driven {
  JointKind kind;
  int axis;
};
void PrintTo(const Driven& one, std::ostream* out) {
  *out << model::traits_of(one.kind).name << " axis " << one.axis + 1;
}

class EveryMotor : public testing::TestWithParam<Driven> {};
INSTANTIATE_TEST_SUITE_P(Joints, EveryMotor,
                         testing::Values(Driven{JointKind::hinge, 0}, Driven{JointKind::slider, 0},
                                         Driven{JointKind::universal, 0}, Driven{JointKind::universal, 1},
                                         Driven{JointKind::hinge2, 0}, Driven{JointKind::hinge2, 1}));

TEST_P(EveryMotor, drives_the_way_that_odes_does_and_as_hard) {
  for (const double force : {0.2, 100.0}) {
    Model model = at_rest(joined(GetParam().kind, Vec3::UnitZ(), Vec3::UnitX()));
    model.joints[0].motors[static_cast<std::size_t>(GetParam().axis)] = {2, force};
    Simulation simulation(model, fine);
    simulation.advance(50);
    const model::State ode = after_ode(model, 50);
    for (int body = 0; body < 2; ++body) {
      EXPECT_LT((simulation.state().velocity[body] - ode.velocity[body]).norm(), 0.02) << force;
      EXPECT_LT((simulation.state().angular_velocity[body] - ode.angular_velocity[body]).norm(), 0.02)
          << force;
    }
    EXPECT_GT(simulation.state().velocity[1].norm() + simulation.state().angular_velocity[1].norm(), 0.01);
  }
}

TEST_P(EveryMotor, turns_back_to_the_pose_that_it_holds) {
  if (!model::traits_of(GetParam().kind).axes[static_cast<std::size_t>(GetParam().axis)].has_limit) return;
  Model model = at_rest(joined(GetParam().kind, Vec3::UnitZ(), Vec3::UnitX()));
  model.joints[0].motors[static_cast<std::size_t>(GetParam().axis)] = {0, 1000, 4};
  model.bodies[1].velocity = {0.3, 0.3, 0};
  model.bodies[1].angular_velocity = {0.5, 0, 0.5};
  Simulation simulation(model, fine);
  simulation.advance(250);
  const model::State ode = after_ode(model, 250);
  EXPECT_LT((simulation.state().position[1] - ode.position[1]).norm(), 2e-3);
  EXPECT_LT(relative_turn(simulation.state()).angularDistance(relative_turn(ode)), 2e-3);
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

/// A mass of 100 kg on a spring that sags by m g / k.
TEST(Joints, of_kind_hinge2_are_sprung) {
  Model model;
  const int actor = support::add_actor(model, "car");
  support::add_solid(model, actor, "body", Shape::box, {1, 1, 1}, 100, {0, 0, 1});
  support::add_solid(model, actor, "wheel", Shape::sphere, {0.3, 0, 0}, 20, {0, 0, 0});
  support::add_joint(model, JointKind::hinge2, 0, 1, {0, 0, 0}, Vec3::UnitZ(), Vec3::UnitX());
  model.joints[0].suspension = {8000, 600};
  support::add_joint(model, JointKind::fixed, 1, model::no_body, {0, 0, 0});
  Simulation simulation(model, fine);
  simulation.advance(2000);
  EXPECT_NEAR(simulation.state().position[0].z(), 1 - 100 * 9.81 / 8000, 0.002);
  EXPECT_LT(simulation.state().velocity[0].norm(), 0.01);
}

TEST(Joints, that_odes_could_not_express_are_refused) {
  Model ball = joined(JointKind::ball, Vec3::UnitZ(), Vec3::UnitX());
  ball.joints[0].motors[0] = {1, 1};
  EXPECT_THROW(Simulation(ball, fine), core::InputError);
  Model limited = joined(JointKind::hinge2, Vec3::UnitZ(), Vec3::UnitX());
  limited.joints[0].limits[1] = {-1, 1};
  EXPECT_THROW(Simulation(limited, fine), core::InputError);
  EXPECT_THROW(Simulation(joined(JointKind::universal, Vec3::UnitZ(), Vec3::UnitZ()), fine),
               core::InputError);
}

}  // namespace
}  // namespace pbmpi::bullet
