/// Joints that are springs: how they hold bodies that turn fast, and bodies that lean on a limit.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "model/names.h"
#include "solver/sor_run.h"
#include "stepping/step_options.h"
#include "support/models.h"

namespace pbmpi::solver {
namespace {

using model::JointKind;
using model::Model;
using model::Vec3;

stepping::StepperSettings settings_with(int substeps) {
  stepping::StepperSettings settings = default_settings(stepping::StepperKind::sor);
  settings.substeps = substeps;
  return settings;
}

/// A bar that spins at 30 rad/s about its end, which a ball joint holds, without gravity.
Model whirling_bar() {
  Model model;
  model.gravity.setZero();
  const int actor = support::add_actor(model, "bar");
  const int bar = support::add_solid(model, actor, "bar", model::Shape::box, {1, 0.1, 0.1}, 2, {0.5, 0, 0});
  support::add_joint(model, JointKind::ball, bar, model::no_body, {0, 0, 0});
  model.bodies[0].angular_velocity = {0, 0, 30};
  model.bodies[0].velocity = {0, 15, 0};
  return model;
}

/// Largest gap [m] in its first second.
double largest_gap_of_whirling_bar(int substeps) {
  const auto stepper = make_stepper(settings_with(substeps), {whirling_bar()});
  double gap_m = 0;
  for (int step = 0; step < 100; ++step) {
    advance(*stepper, 1);
    gap_m = std::max(gap_m, stepper->observables(0).joint_gap_m);
  }
  return gap_m;
}

// With the arms of a substep's start each substep would open a gap of second order, of which half a substep
// leaves a quarter.
TEST(SoftJoints, hold_what_whirls_to_third_order) {
  double before_m = largest_gap_of_whirling_bar(6);
  EXPECT_LT(before_m, 2e-3)
      << "a substep turns the bar by 0.05 rad, so that its end is off by 1.25 mm by then";
  for (const int substeps : {12, 24}) {
    const double gap_m = largest_gap_of_whirling_bar(substeps);
    EXPECT_GT(gap_m, 0);
    EXPECT_LT(gap_m, before_m / 6) << substeps;
    before_m = gap_m;
  }
}

/// Two boxes of 100 kg that light ones between them join at the ends of long arms, in space. A light pair,
/// fixed to each other, is hurled around whenever the heavy ones have pulled it straight.
Model hurled_pair() {
  Model model;
  model.gravity.setZero();
  const int actor = support::add_actor(model, "boxes");
  const auto add = [&](const char* name, double mass_kg, const Vec3& size, const Vec3& position) {
    return support::add_solid(model, actor, name, model::Shape::box, {size.x(), size.y(), size.z()}, mass_kg,
                              position, support::rotation(Vec3(1, 2, -1).normalized(), 0.7));
  };
  const int first = add("first", 100, {0.6, 0.4, 0.5}, {0, 0, 0});
  const int light = add("light", 0.4, {0.3, 0.1, 0.2}, {1, 0, 0});
  const int other = add("other", 0.25, {0.1, 0.4, 0.2}, {1, 0.3, 0.2});
  const int last = add("last", 100, {0.4, 0.6, 0.5}, {1.6, 0.9, 0});
  support::add_joint(model, JointKind::ball, light, first, {0.6, 0.1, 0});
  support::add_joint(model, JointKind::fixed, other, light, {1, 0.15, 0.1});
  support::add_joint(model, JointKind::ball, last, light, {1.3, 0.3, 0.1});
  model.bodies[first].angular_velocity = {0.4, 0.2, 2};
  model.bodies[last].angular_velocity = {-0.3, 1, -2};
  model.geoms.clear();
  return model;
}

/// [rad] The most by which the fixed joint of hurled_pair() bends in 10 s.
double largest_bend_of_hurled_pair(int substeps) {
  const Model model = hurled_pair();
  const auto stepper = make_stepper(settings_with(substeps), {model});
  const auto turn = [](const model::Quat& a, const model::Quat& b) {
    return Eigen::Quaterniond(a.to_eigen().conjugate() * b.to_eigen());
  };
  const Eigen::Quaterniond before = turn(model.bodies[1].pose.orientation, model.bodies[2].pose.orientation);
  double bend = 0;
  for (int step = 0; step < 1000; ++step) {
    advance(*stepper, 1);
    const model::State& state = stepper->state(0);
    bend = std::max(bend, turn(state.orientation[1], state.orientation[2]).angularDistance(before));
  }
  return bend;
}

// A substep of 14 turns the pair by up to 1.9e-3 rad. An error of second order, as where the bodies' own
// inertia is not reckoned with, bends it by 1.7e-7 rad, one of third order, a^3 / 12, by 6e-10.
TEST(SoftJoints, exact_ones_hold_what_is_hurled_around_to_third_order) {
  const double bend = largest_bend_of_hurled_pair(14);
  EXPECT_LT(bend, 2e-9);
  EXPECT_LT(largest_bend_of_hurled_pair(28), bend / 6);
}

/// The share of a gap of 1 mm that remains, at the middle of a free body that a ball joint pulls to the
/// world.
double share_left_of_a_gap(stepping::JointSolver solver, double damping) {
  Model model;
  model.gravity.setZero();
  const int actor = support::add_actor(model, "box");
  support::add_solid(model, actor, "box", model::Shape::box, {0.2, 0.2, 0.2}, 3, {0, 0, 1});
  support::add_joint(model, JointKind::ball, 0, model::no_body, {0, 0, 1});
  model::State state = model::initial_state(model);
  state.position[0].x() += 1e-3;
  stepping::StepperSettings settings = settings_with(1);
  settings.law.joint_solver = solver;
  settings.law.joint_damping = damping;
  const auto stepper = make_stepper(settings);
  stepper->add(0, std::make_shared<const Model>(model), state, 0);
  advance(*stepper, 1);
  EXPECT_LT(stepper->state(0).velocity[0].norm(), 1e-12) << "the relaxing sweep takes the speed back";
  return stepper->state(0).position[0].x() / 1e-3;
}

// The ERP of a spring with 0.2 periods per substep, a / (2 z + a) with a = 0.4 pi. A swept row is also soft:
// with its CFM, 1 / (a (2 z + a)), it closes 1 / (1 + CFM) of its gap.
TEST(SoftJoints, close_gaps_by_their_damping_and_exact_ones_by_a_small_one) {
  const double a = 0.4 * M_PI;
  const auto erp = [a](double damping) { return a / (2 * damping + a); };
  EXPECT_NEAR(share_left_of_a_gap(stepping::JointSolver::hanging, 3), 1 - erp(0.7), 1e-7);
  EXPECT_NEAR(share_left_of_a_gap(stepping::JointSolver::hanging, 0.3), 1 - erp(0.3), 1e-7);
  const double cfm = 1 / (a * (6 + a));
  EXPECT_NEAR(share_left_of_a_gap(stepping::JointSolver::sweeps, 3), 1 - erp(3) / (1 + cfm), 1e-7);
}

/// Bars that hang on the world one below the other, level at the start, on hinges that bend by 0.1 rad.
Model bars_at_their_limits(int num_bars) {
  Model model;
  model.angular_damping = 2;
  const int actor = support::add_actor(model, "bars");
  for (int i = 0; i < num_bars; ++i) {
    support::add_solid(model, actor, "bar" + std::to_string(i), model::Shape::box, {0.2, 0.05, 0.05}, 1,
                       {0.1 + 0.2 * i, 0, 0});
    support::add_joint(model, JointKind::hinge, i, i == 0 ? model::no_body : i - 1, {0.2 * i, 0, 0},
                       Vec3::UnitY());
    model.joints.back().limits[0] = {-0.1, 0.1};
  }
  return model;
}

// A limit that pushed as hard as needed, and remembered it, would make all of them tremble.
TEST(SoftJoints, rest_at_their_limits) {
  for (const stepping::JointSolver solver : {stepping::JointSolver::hanging, stepping::JointSolver::tree}) {
    stepping::StepperSettings settings = settings_with(12);
    settings.law.joint_solver = solver;
    const auto stepper = make_stepper(settings, {bars_at_their_limits(8)});
    advance(*stepper, 1500);
    for (int step = 0; step < 100; ++step) {
      advance(*stepper, 1);
      for (const Vec3& velocity : stepper->state(0).velocity) ASSERT_LT(velocity.norm(), 1e-3);
    }
    EXPECT_LT(stepper->state(0).position[7].z(), -0.5) << "they hang";
  }
}

// The part of a motor's force that pushes into its own limit acts on no body.
TEST(SoftJoints, give_no_way_to_a_motor_that_pushes_into_its_limit) {
  Model model;
  model.gravity.setZero();
  const int actor = support::add_actor(model, "door");
  support::add_solid(model, actor, "door", model::Shape::box, {0.8, 0.05, 2}, 20, {0.4, 0, 0});
  support::add_joint(model, JointKind::hinge, 0, model::no_body, {0, 0, 0}, Vec3::UnitZ());
  model.joints[0].limits[0] = {-0.5, 0.5};
  model.joints[0].motors[0] = {.velocity = 1, .max_force = 1e5};
  const auto stepper = make_stepper(settings_with(12), {model});
  advance(*stepper, 300);
  const Vec3& place = stepper->state(0).position[0];
  EXPECT_NEAR(std::abs(std::atan2(place.y(), place.x())), 0.5, 1e-3);
  EXPECT_LT(stepper->state(0).angular_velocity[0].norm(), 1e-3);
}

}  // namespace
}  // namespace pbmpi::solver
