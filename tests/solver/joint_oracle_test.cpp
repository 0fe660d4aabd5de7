/// Each kind of joint against ODE: with enough iterations the motion is that of dWorldStep, the big-matrix
/// solver.
#include <gtest/gtest.h>

#include <array>

#include "model/names.h"
#include "ode/ode_stepper.h"
#include "solver/sor_run.h"
#include "stepping/step_options.h"
#include "support/models.h"

namespace pbmpi::solver {
namespace {

using model::JointKind;
using model::Vec3;
using support::rotation;

/// Enough for a few joints: the change over the last thousand iterations is below rounding.
constexpr int converged = 4000;
/// [m/s, rad/s] Difference between two solutions of one system with condition number 1e4 or so; a wrong sign
/// or factor gives 1e-2 and more.
constexpr double tolerance = 1e-8;

/// Two unequal boxes with a joint of this kind, moving against each other, the first one also attached to the
/// world.
model::Model linked_boxes(JointKind kind) {
  model::Model model;
  const int actor = support::add_actor(model, "boxes");
  const int a = support::add_solid(model, actor, "a", model::Shape::box, {0.4, 0.3, 0.2}, 3, {0, 0, 1},
                                   rotation(Vec3(1, 2, -1).normalized(), 0.4));
  const int b = support::add_solid(model, actor, "b", model::Shape::box, {0.3, 0.5, 0.2}, 2, {0.5, 0.1, 1.1},
                                   rotation(Vec3(-1, 1, 1).normalized(), 0.9));
  const Vec3 axis1 = Vec3(0.2, 1, 0.3).normalized();
  const Vec3 axis2 = axis1.cross(Vec3(1, 0.3, 0)).normalized();
  support::add_joint(model, kind, a, b, {0.25, 0.05, 1.05}, axis1, axis2);
  support::add_joint(model, JointKind::ball, a, model::no_body, {-0.2, 0, 1.1});
  model.bodies[a].velocity = {0.3, -0.2, 0.1};
  model.bodies[a].angular_velocity = {1, -2, 0.5};
  model.bodies[b].velocity = {-0.2, 0.4, 0.3};
  model.bodies[b].angular_velocity = {-1.5, 1, 2};
  return model;
}

std::unique_ptr<stepping::WorldStepper> reference(const model::Model& model) {
  stepping::StepperSettings settings = default_settings(stepping::StepperKind::direct);
  auto stepper = ode::make_ode_stepper(settings, [](const std::string&) {});  // its LCP solver is chatty
  stepper->add(0, std::make_shared<const model::Model>(model), model::initial_state(model), 0);
  return stepper;
}

stepping::StepperSettings sweeps() {
  stepping::StepperSettings settings = default_settings(stepping::StepperKind::sor, stepping::Law::ode);
  settings.iterations = converged;
  return settings;
}

/// Joints solved by their trees: one iteration suffices.
stepping::StepperSettings trees() {
  stepping::StepperSettings settings = sweeps();
  settings.iterations = 1;
  settings.law.joint_solver = stepping::JointSolver::tree;
  return settings;
}

/// The largest difference of a velocity after `num_steps` steps.
double velocity_difference(const model::Model& model, int num_steps,
                           const stepping::StepperSettings& settings = sweeps()) {
  const auto own = make_stepper(settings, {model});
  const auto direct = reference(model);
  advance(*own, num_steps);
  advance(*direct, num_steps);
  double largest = 0;
  for (std::size_t i = 0; i < model.bodies.size(); ++i) {
    largest = std::max(
        {largest, (own->state(0).velocity[i] - direct->state(0).velocity[i]).cwiseAbs().maxCoeff(),
         (own->state(0).angular_velocity[i] - direct->state(0).angular_velocity[i]).cwiseAbs().maxCoeff()});
  }
  return largest;
}

class JointOracle : public testing::TestWithParam<JointKind> {};

TEST_P(JointOracle, moves_as_with_the_big_matrix) {
  for (const int num_steps : {1, 5})
    EXPECT_LT(velocity_difference(linked_boxes(GetParam()), num_steps), tolerance) << num_steps;
}

TEST_P(JointOracle, an_error_at_the_start_is_corrected_alike) {
  model::Model model = linked_boxes(GetParam());
  model.joints[0].anchor_b += Vec3(0.01, -0.02, 0.015);
  EXPECT_LT(velocity_difference(model, 3), tolerance);
}

TEST_P(JointOracle, a_tree_is_solved_in_one_iteration) {
  model::Model model = linked_boxes(GetParam());
  EXPECT_LT(velocity_difference(model, 5, trees()), tolerance);
  model.joints[0].anchor_b += Vec3(0.01, -0.02, 0.015);
  EXPECT_LT(velocity_difference(model, 3, trees()), tolerance);
  std::swap(model.joints[0], model.joints[1]);
  EXPECT_LT(velocity_difference(model, 3, trees()), tolerance) << "in another order";
}

TEST_P(JointOracle, a_tree_that_hangs_nowhere_is_solved_in_one_iteration) {
  model::Model model = linked_boxes(GetParam());
  model.joints.pop_back();
  EXPECT_LT(velocity_difference(model, 5, trees()), tolerance);
}

TEST_P(JointOracle, a_motor_drives_alike) {
  model::Model model = linked_boxes(GetParam());
  if (GetParam() == JointKind::ball || GetParam() == JointKind::fixed) GTEST_SKIP() << "has no axis";
  model.joints[0].motors[0] = {1.5, 40};  // strong: reaches its velocity
  EXPECT_LT(velocity_difference(model, 3), tolerance);
  model.joints[0].motors[0] = {-30, 0.7};  // weak: pushes with all its force
  EXPECT_LT(velocity_difference(model, 3), tolerance);
}

TEST_P(JointOracle, limits_hold_alike) {
  model::Model model = linked_boxes(GetParam());
  if (GetParam() == JointKind::ball || GetParam() == JointKind::fixed) GTEST_SKIP() << "has no axis";
  model.joints[0].limits[0] = {-0.01, 0.01};  // either direction is blocked within a step
  EXPECT_LT(velocity_difference(model, 6), tolerance);
  model.joints[0].limits[0] = {0.05, 0.3};  // starts beyond its low limit
  EXPECT_LT(velocity_difference(model, 4), tolerance);
  model.joints[0].limits[0] = {0.02, 0.02};  // pinned, like a steered wheel
  EXPECT_LT(velocity_difference(model, 4), tolerance);
}

TEST_P(JointOracle, a_motor_that_holds_a_pose_turns_back_alike) {
  model::Model model = linked_boxes(GetParam());
  if (GetParam() == JointKind::ball || GetParam() == JointKind::fixed) GTEST_SKIP() << "has no axis";
  for (const auto& [velocity, force, rate] :
       {std::array{0.0, 40.0, 20.0}, std::array{1.5, 0.7, 50.0}, std::array{0.0, 40.0, 1e3}}) {
    model.joints[0].motors[0] = {velocity, force, rate};  // strong, weak, and faster than a step allows
    EXPECT_LT(velocity_difference(model, 5), tolerance) << rate;
  }
  model.joints[0].limits[0] = {0.05, 0.3};   // beyond its low limit the motor only pushes
  model.joints[0].motors[0] = {2, 0.5, 20};  // clearly upwards: at angle 0 rounding would choose the side
  EXPECT_LT(velocity_difference(model, 2), tolerance);
}

TEST_P(JointOracle, a_motor_at_its_limit_pushes_alike) {
  model::Model model = linked_boxes(GetParam());
  if (GetParam() == JointKind::ball || GetParam() == JointKind::fixed) GTEST_SKIP() << "has no axis";
  model.joints[0].limits[0] = {0.05, 0.3};
  for (const double velocity : {0.0, 2.0, -2.0}) {
    model.joints[0].motors[0] = {velocity, 0.5};
    EXPECT_LT(velocity_difference(model, 2), tolerance) << velocity;
  }
}

/// The first box of linked_boxes() alone, held to the world by a joint of this kind.
model::Model box_on_the_world(JointKind kind) {
  model::Model model = linked_boxes(kind);
  model.joints.pop_back();
  model.joints[0].body_b = model::no_body;
  model::Joint& joint = model.joints[0];
  const model::Pose& pose = model.bodies[0].pose;
  joint.anchor_b = pose.point_to_outer(joint.anchor_a);
  joint.axis2_b = pose.direction_to_outer(joint.axis1_a).cross(Vec3(0.3, 0, 1)).normalized();
  return model;
}

/// The same world at another position.
model::Model moved(model::Model model, const Vec3& by) {
  for (model::Body& body : model.bodies) body.pose.position += by;
  for (model::Joint& joint : model.joints) {
    if (joint.body_b == model::no_body) joint.anchor_b += by;
  }
  return model;
}

TEST_P(JointOracle, moves_alike_far_from_the_origin) {
  for (const double distance : {0.0, 10.0, 400.0, 1e5}) {
    // Positions are rounded to 1.5e-11 m at 1e5 m, and errors of 1e-11 m are corrected at 20 1/s.
    const double rounding = 1e-14 * distance / 1e-3;
    const Vec3 by = distance * Vec3(0.6, -0.8, 0);
    EXPECT_LT(velocity_difference(moved(linked_boxes(GetParam()), by), 3), tolerance + rounding) << distance;
    if (GetParam() == JointKind::hinge2) continue;  // ODE's needs two bodies
    EXPECT_LT(velocity_difference(moved(box_on_the_world(GetParam()), by), 3), tolerance + rounding)
        << distance << " m, on the world";
  }
}

TEST_P(JointOracle, limits_and_motors_on_the_world_act_alike_far_from_the_origin) {
  if (GetParam() == JointKind::ball || GetParam() == JointKind::fixed) GTEST_SKIP() << "has no axis";
  if (GetParam() == JointKind::hinge2) GTEST_SKIP() << "ODE's needs two bodies";
  for (const double distance : {0.0, 10.0, 400.0, 1e5}) {
    const double rounding = 1e-14 * distance / 1e-3;
    model::Model model = moved(box_on_the_world(GetParam()), distance * Vec3(0.6, -0.8, 0));
    model.joints[0].motors[0] = {1.5, 40};
    EXPECT_LT(velocity_difference(model, 3), tolerance + rounding) << distance;
    model.joints[0].motors[0] = {};
    model.joints[0].limits[0] = {0.05, 0.3};
    EXPECT_LT(velocity_difference(model, 3), tolerance + rounding) << distance;
  }
}

INSTANTIATE_TEST_SUITE_P(EveryKind, JointOracle,
                         testing::Values(JointKind::ball, JointKind::hinge, JointKind::slider,
                                         JointKind::universal, JointKind::fixed, JointKind::hinge2),
                         [](const auto& test) { return std::string(name_of(test.param)); });

TEST(JointOracle, a_universal_joint_limits_and_drives_its_second_axis_alike) {
  model::Model model = linked_boxes(JointKind::universal);
  model.joints[0].limits[1] = {0.05, 0.3};
  EXPECT_LT(velocity_difference(model, 4), tolerance);
  model.joints[0].limits[1] = {};
  model.joints[0].motors[1] = {2, 0.5};
  EXPECT_LT(velocity_difference(model, 4), tolerance);
  model.joints[0].motors[1] = {0, 40, 30};
  EXPECT_LT(velocity_difference(model, 5), tolerance);
}

TEST(JointOracle, a_suspension_springs_alike) {
  model::Model model = linked_boxes(JointKind::hinge2);
  model.joints[0].suspension = {20000, 1500};
  model.joints[0].motors[1] = {5, 3};
  EXPECT_LT(velocity_difference(model, 5), tolerance);
}

TEST(JointOracle, a_body_spins_freely_alike) {
  EXPECT_LT(velocity_difference(support::free_box(), 20), tolerance);
}

TEST(JointTrees, solve_a_long_chain_under_a_weight_in_one_iteration) {
  model::Model model = support::chain(20);
  model.bodies.back().mass_kg *= 1000;
  model.bodies.back().inertia *= 1000;
  EXPECT_LT(velocity_difference(model, 10, trees()), 1e-6);
  EXPECT_GT(velocity_difference(model, 10, sweeps()), 1e-3) << "thousands of sweeps do not";
}

TEST(JointTrees, solve_what_closes_a_loop_by_sweeps) {
  model::Model model = linked_boxes(JointKind::ball);
  support::add_joint(model, JointKind::ball, 1, model::no_body, {0.6, 0.2, 1.2});
  stepping::StepperSettings settings = trees();
  settings.iterations = converged;
  EXPECT_LT(velocity_difference(model, 5, settings), tolerance);
}

// With an inertia other than that of contacts and limits a limb that turns far in a step would gain energy,
// more so with more substeps: what one row takes out, another puts back.
TEST(JointTrees, throw_nobody_in_a_crash_however_many_substeps_there_are) {
  stepping::StepperSettings settings = default_settings(stepping::StepperKind::sor);
  settings.law.joint_solver = stepping::JointSolver::tree;
  for (const int substeps : {8, 12, 32}) {
    settings.substeps = substeps;
    const auto stepper = make_stepper(settings, {support::crash(0)});
    for (int step = 0; step < 20; ++step) {
      advance(*stepper, 1);
      for (const core::Vec3& velocity : stepper->state(0).velocity)
        ASSERT_LT(velocity.norm(), 75) << substeps << " substeps, step " << step << ": a car at 25 m/s";
    }
  }
}

TEST(JointTrees, have_the_same_bits_in_every_width) {
  stepping::StepperSettings settings = default_settings(stepping::StepperKind::sor);
  settings.law.joint_solver = stepping::JointSolver::tree;
  for (const stepping::Precision precision : {stepping::Precision::double_, stepping::Precision::single}) {
    settings.precision = precision;
    settings.simd = stepping::Simd::off;
    const auto one_lane = make_stepper(settings, {support::crash(0), support::crash(1), support::crash(2)});
    advance(*one_lane, 20);
    for (const stepping::Simd simd : machine_simds()) {
      settings.simd = simd;
      const auto lanes = make_stepper(settings, {support::crash(0), support::crash(1), support::crash(2)});
      const auto alone = make_stepper(settings, {support::crash(1)});
      advance(*lanes, 20);
      advance(*alone, 20);
      for (const int world : {0, 1, 2})
        EXPECT_EQ(model::hash(lanes->state(world)), model::hash(one_lane->state(world))) << world;
      EXPECT_EQ(model::hash(alone->state(0)), model::hash(one_lane->state(1)));
    }
  }
}

}  // namespace
}  // namespace pbmpi::solver
