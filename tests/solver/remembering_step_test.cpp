/// The motion of bodies in the step with which sor is meant to be used.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "model/mechanics.h"
#include "solver/sor_run.h"
#include "stepping/names.h"
#include "stepping/step_options.h"
#include "support/models.h"

namespace pbmpi::solver {
namespace {

using model::Vec3;
using stepping::Friction;
using stepping::Precision;

constexpr double degree = 0.017453292519943295;  // [rad]

stepping::StepperSettings settings_of(Precision precision) {
  stepping::StepperSettings settings = default_settings(stepping::StepperKind::sor);
  settings.precision = precision;
  return settings;
}

/// Distance [m] that a box slides at mu = 0.3, starting with 3 m/s in this direction [rad].
double way_of_sliding_box(double heading, Friction friction) {
  model::Model model = support::box_over_ground(0);
  for (model::Geom& geom : model.geoms) geom.material.mu = 0.3;
  const Vec3 direction(std::cos(heading), std::sin(heading), 0);
  model.bodies[0].velocity = 3 * direction;
  stepping::StepperSettings settings = settings_of(Precision::double_);
  settings.law.friction = friction;
  const auto stepper = make_stepper(settings, {model});
  advance(*stepper, 150);
  const Vec3 way = stepper->state(0).position[0] - model.bodies[0].pose.position;
  EXPECT_LT(stepper->state(0).velocity[0].norm(), 1e-3) << "it has come to rest";
  EXPECT_LT((way - way.dot(direction) * direction).norm(), 0.02 * way.norm() + 1e-3) << "straight on";
  return way.dot(direction);
}

TEST(RememberingStep, brakes_a_sliding_box_alike_in_every_direction) {
  const double expected_m = 3 * 3 / (2 * 0.3 * 9.81);
  for (const Friction friction : {Friction::cone, Friction::patch}) {
    for (const double heading : {0.0, 15.0, 30.0, 45.0, 100.0, 225.0, 340.0})
      EXPECT_NEAR(way_of_sliding_box(heading * degree, friction), expected_m, 0.01 * expected_m)
          << heading << " " << static_cast<int>(friction);
  }
}

TEST(RememberingStep, with_the_pyramid_brakes_harder_along_the_diagonal) {
  const double along_axis_m = way_of_sliding_box(0, Friction::pyramid);
  const double diagonal_m = way_of_sliding_box(45 * degree, Friction::pyramid);
  EXPECT_NEAR(diagonal_m, along_axis_m / std::sqrt(2.0), 0.02 * along_axis_m);
}

/// The angular velocity [rad/s] in the body's frame.
Vec3 turned_back(const model::State& state) {
  return state.orientation[0].to_eigen().conjugate() * state.angular_velocity[0];
}

class BothPrecisions : public testing::TestWithParam<Precision> {};

TEST_P(BothPrecisions, a_tumbling_box_keeps_its_angular_momentum_and_its_energy) {
  for (const std::array<double, 3>& size : {std::array{2.0, 1.0, 0.5}, std::array{0.1, 0.4, 0.9}}) {
    model::Model model;
    model.gravity = Vec3::Zero();
    support::add_solid(model, support::add_actor(model, "box"), "box", model::Shape::box, size, 10,
                       {0, 0, 0});
    model.bodies[0].angular_velocity = {0.1, 5,
                                        0.1};  // about the middle axis, which it leaves again and again
    const model::State start = model::initial_state(model);
    const double energy_j = model::mechanical_energy(model, start);
    const Vec3 momentum = model::angular_momentum(model, start);
    const auto stepper = make_stepper(settings_of(GetParam()), {model});
    double least_y = 5;
    for (int step = 0; step < 1000; ++step) {
      advance(*stepper, 1);
      const model::State& state = stepper->state(0);
      least_y = std::min(least_y, turned_back(state).y());
      ASSERT_NEAR(model::angular_momentum(model, state).norm(), momentum.norm(), 2e-3 * momentum.norm())
          << step;
      ASSERT_NEAR(model::mechanical_energy(model, state), energy_j, 0.01 * energy_j) << step;
    }
    EXPECT_LT(least_y, -4) << "it has turned over";
  }
}

INSTANTIATE_TEST_SUITE_P(RememberingStep, BothPrecisions,
                         testing::Values(Precision::double_, Precision::single));

}  // namespace
}  // namespace pbmpi::solver
