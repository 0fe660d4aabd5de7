/// The purpose of substeps, and the side effects that they must not have.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "model/names.h"
#include "solver/sor_run.h"
#include "stepping/names.h"
#include "stepping/stepper_traits.h"
#include "support/models.h"

namespace pbmpi::solver {
namespace {

using model::JointKind;
using model::Vec3;

stepping::StepperSettings settings_of(int substeps, int iterations) {
  stepping::StepperSettings settings = default_settings(stepping::StepperKind::sor, stepping::Law::ode);
  settings.substeps = substeps;
  settings.iterations = iterations;
  return settings;
}

/// RMS over 100 steps of the largest joint gap [m] of a chain that swings down.
double gap_of_swinging_chain(int substeps, int iterations, stepping::Precision precision) {
  stepping::StepperSettings settings = settings_of(substeps, iterations);
  settings.precision = precision;
  const auto stepper = make_stepper(settings, {support::chain(12)});
  double squares = 0;
  for (int step = 0; step < 100; ++step) {
    advance(*stepper, 1);
    squares += std::pow(stepper->observables(0).joint_gap_m, 2);
  }
  return std::sqrt(squares / 100);
}

TEST(Substeps, close_the_gaps_of_a_swinging_chain_at_the_same_number_of_sweeps) {
  for (const stepping::Precision precision : {stepping::Precision::double_, stepping::Precision::single}) {
    double before_m = std::numeric_limits<double>::infinity();
    for (const int substeps : {1, 2, 4, 8}) {
      const double gap_m = gap_of_swinging_chain(substeps, 40 / substeps, precision);
      // A gap is of second order in the substep, so half of it leaves a quarter; the fewer sweeps of each
      // substep cancel some of that.
      EXPECT_LT(gap_m, 0.6 * before_m) << substeps << " substeps";
      before_m = gap_m;
    }
  }
}

/// The kinetic energy [J] after one step of a cube that starts `depth` [m] deep in the ground; without
/// gravity.
double energy_from_depth(double depth, int substeps, int iterations) {
  model::Model cube = support::box_over_ground(-depth);
  cube.gravity = Vec3::Zero();
  const auto stepper = make_stepper(settings_of(substeps, iterations), {cube});
  advance(*stepper, 1);
  return stepper->observables(0).energy_j;
}

TEST(Substeps, push_a_deep_contact_out_no_faster_than_a_step_without_them) {
  const double once_j = energy_from_depth(0.1, 1, 20);
  EXPECT_GT(once_j, 1) << "ERP 0.2 of 0.1 m in 0.01 s is 2 m/s, and the cube has 10 kg";
  for (const int substeps : {2, 5, 16, 50}) {
    // A push at ERP per substep would give the square of their number; the residual of a sweep is far less.
    EXPECT_LT(energy_from_depth(0.1, substeps, 4), 1.2 * once_j) << substeps << " substeps";
  }
}

/// Two unequal boxes with a joint of this kind, the first one attached to the world; they swing and spin.
model::Model swinging_boxes(JointKind kind) {
  model::Model model;
  const int actor = support::add_actor(model, "boxes");
  const int a = support::add_solid(model, actor, "a", model::Shape::box, {0.4, 0.3, 0.2}, 3, {0, 0, 1});
  const int b = support::add_solid(model, actor, "b", model::Shape::box, {0.3, 0.5, 0.2}, 2, {0.5, 0.1, 1.1});
  const Vec3 axis1 = Vec3(0.2, 1, 0.3).normalized();
  support::add_joint(model, kind, a, b, {0.25, 0.05, 1.05}, axis1, axis1.cross(Vec3(1, 0.3, 0)).normalized());
  support::add_joint(model, JointKind::ball, a, model::no_body, {-0.2, 0, 1.1});
  model.bodies[static_cast<std::size_t>(a)].angular_velocity = {2, -4, 1};
  model.bodies[static_cast<std::size_t>(b)].angular_velocity = {-3, 2, 4};
  return model;
}

class EveryJoint : public testing::TestWithParam<JointKind> {};

double farthest(const model::State& a, const model::State& b) {
  double distance_m = 0;
  for (std::size_t i = 0; i < a.position.size(); ++i)
    distance_m = std::max(distance_m, (a.position[i] - b.position[i]).norm());
  return distance_m;
}

TEST_P(EveryJoint, comes_nearer_to_the_motion_of_small_steps) {
  stepping::StepperSettings small = settings_of(1, 200);
  small.dt_s /= 50;
  const model::Model model = swinging_boxes(GetParam());
  const auto reference = make_stepper(small, {model});
  const auto one = make_stepper(settings_of(1, 200), {model});
  const auto five = make_stepper(settings_of(5, 200), {model});
  for (int step = 0; step < 20; ++step) {
    advance(*reference, 50);
    advance(*one, 1);
    advance(*five, 1);
  }
  EXPECT_GT(farthest(model::initial_state(model), reference->state(0)), 0.1) << "it must move";
  // The error of gaps and angles is of the square of the substep; that of inertia and axes, which are fixed
  // through a step, is of the step's own order and smaller.
  EXPECT_LT(2 * farthest(five->state(0), reference->state(0)), farthest(one->state(0), reference->state(0)));
}

INSTANTIATE_TEST_SUITE_P(Substeps, EveryJoint,
                         testing::Values(JointKind::ball, JointKind::hinge, JointKind::slider,
                                         JointKind::universal, JointKind::fixed, JointKind::hinge2),
                         [](const auto& test) { return std::string(name_of(test.param)); });

TEST(Substeps, stop_an_axis_at_the_limit_that_it_reaches_within_a_step) {
  for (const JointKind kind : {JointKind::hinge, JointKind::slider, JointKind::universal}) {
    model::Model model = swinging_boxes(kind);
    model.gravity = Vec3::Zero();
    model.joints[0].limits[0] = {-0.02, 0.02};  // [rad] or [m]: a third of what it does in a step
    model.bodies[1].angular_velocity = {0, 8, 0};
    model.bodies[1].velocity = {0, 8, 0};
    stepping::StepperSettings small = settings_of(1, 200);
    small.dt_s /= 5;
    const auto reference = make_stepper(small, {model});
    const auto substeps = make_stepper(settings_of(5, 200), {model});
    advance(*reference, 5);
    advance(*substeps, 1);
    // As in small steps except for the directions, which are fixed through the step: 8 /s x 0.01 s of 8 m/s.
    for (std::size_t body = 0; body < 2; ++body) {
      EXPECT_LT((substeps->state(0).velocity[body] - reference->state(0).velocity[body]).norm(), 0.64)
          << name_of(kind);
    }
  }
}

/// Worlds of equal articulations, each of which does something else: another kind of joint, a limit that only
/// some reach, contacts that only some have.
std::vector<model::Model> unlike_worlds() {
  std::vector<model::Model> worlds;
  for (const JointKind kind :
       {JointKind::hinge, JointKind::universal, JointKind::hinge2, JointKind::slider}) {
    for (int variant = 0; variant < 5; ++variant) {
      model::Model model = swinging_boxes(kind);
      model.joints[0].limits[0] = {-0.02 * variant, 0.05};
      if (variant == 2) model.joints[0].motors[0] = {1, 5, 10};
      if (variant == 3) model.joints[0].limits[0] = {};
      if (kind == JointKind::hinge2 && variant > 2) model.joints[0].suspension = {20000, 1500};
      worlds.push_back(model);
    }
  }
  for (int variant = 0; variant < 3; ++variant) worlds.push_back(support::crash(variant));
  worlds.push_back(support::pile(5));
  worlds.push_back(support::chain(7));
  return worlds;
}

std::vector<std::uint64_t> hashes_after_20_steps(const stepping::StepperSettings& settings,
                                                 const std::vector<model::Model>& worlds) {
  const auto stepper = make_stepper(settings, worlds);
  advance(*stepper, 20);
  std::vector<std::uint64_t> hashes;
  for (std::size_t world = 0; world < worlds.size(); ++world)
    hashes.push_back(model::hash(stepper->state(static_cast<int>(world))));
  return hashes;
}

TEST(Substeps, give_the_same_bits_for_every_width_and_for_a_world_alone) {
  const std::vector<model::Model> worlds = unlike_worlds();
  for (const stepping::Precision precision : {stepping::Precision::double_, stepping::Precision::single}) {
    for (const auto& [substeps, iterations] : {std::pair{5, 3}, std::pair{3, 1}}) {
      stepping::StepperSettings settings = settings_of(substeps, iterations);
      settings.precision = precision;
      settings.simd = stepping::Simd::off;
      std::vector<std::uint64_t> alone;
      for (const model::Model& world : worlds)
        alone.push_back(hashes_after_20_steps(settings, {world}).front());
      for (const stepping::Simd simd : machine_simds()) {
        settings.simd = simd;
        EXPECT_EQ(hashes_after_20_steps(settings, worlds), alone) << static_cast<int>(simd);
      }
    }
  }
}

}  // namespace
}  // namespace pbmpi::solver
