// --tolerance: quiet islands get one substep.
#include "solver/parts/quiet_islands.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "solver/parts/yards.h"
#include "stepping/stepper_traits.h"

namespace pbmpi::solver {
namespace {

using namespace testing_support;

constexpr double tolerance_m = 3e-5;

StepperSettings settings_with(double tolerance) {
  StepperSettings settings = default_settings(stepping::StepperKind::sor);
  settings.tolerance_m = tolerance;
  return settings;
}

TEST(QuietIslands, what_rests_gets_one_substep_and_what_is_hit_gets_all) {
  const auto stepper = start(settings_with(tolerance_m), yard_with_ball(300));
  advance(*stepper, 200);
  double sweeps = 0;
  for (int step = 200; step < 300; ++step) {
    advance(*stepper, 1);
    sweeps += sweeps_a_row(*stepper) / 100;
  }
  EXPECT_LT(sweeps, 9) << "one sweep and six relaxing ones, now and then all 28";
  advance(*stepper, 40);
  EXPECT_GT(sweeps_a_row(*stepper), 12) << "the ball is in the stack";
}

TEST(QuietIslands, what_is_quiet_stays_where_all_substeps_would_keep_it) {
  const Model model = yards(true, false);
  const auto all = start(settings_with(0), model), quiet = start(settings_with(tolerance_m), model);
  advance(*all, 1000);
  advance(*quiet, 1000);
  for (int body = 0; body < model.num_bodies(); ++body) {
    EXPECT_LT((all->state(0).position[body] - quiet->state(0).position[body]).norm(), 1e-3) << body;
    EXPECT_LT(quiet->state(0).velocity[body].norm() * 0.01, tolerance_m) << body;
  }
}

TEST(QuietIslands, change_no_bit_of_a_world_that_moves) {
  Model model = yards(true, true);
  for (model::Body& body : model.bodies) body.velocity = {0.5, 0.1, 0};
  const auto all = start(settings_with(0), model), quiet = start(settings_with(1e-9), model);
  for (int step = 0; step < 30; ++step) {
    advance(*all, 1);
    advance(*quiet, 1);
    ASSERT_EQ(model::hash(all->state(0)), model::hash(quiet->state(0))) << step;
  }
}

// At step 0 nothing moves, and all islands are predicted to be quiet; then everything falls.
TEST(QuietIslands, what_begins_to_move_is_put_back_with_all_its_forces) {
  Model model = yards(true, true);
  model.bodies.front().velocity = {0, 0, -1};  // keeps the first stack from ever being quiet
  for (int i = 4; i < 8; ++i) model.bodies[static_cast<std::size_t>(i)].pose.position.z() += 2;
  for (int step : {0, 10}) {
    StepperSettings settings = settings_with(0);
    const auto path = start(settings, model);
    advance(*path, step);
    State state = path->state(0);
    for (int i = 4; i < 8; ++i) {
      state.velocity[static_cast<std::size_t>(i)].setZero();  // in the air
      state.angular_velocity[static_cast<std::size_t>(i)].setZero();
    }
    const auto all = start(settings, model, state, step);
    settings.tolerance_m = 1e-6;
    const auto quiet = start(settings, model, state, step);
    advance(*all, 1);
    advance(*quiet, 1);
    EXPECT_EQ(model::hash(part(all->state(0), 4, 4)), model::hash(part(quiet->state(0), 4, 4))) << step;
    const auto force = [](const stepping::WorldStepper& stepper) {
      return stepper.state(0).memory.joints.front().force;
    };
    EXPECT_EQ(force(*all), force(*quiet));
  }
}

/// The prediction of foresee() for one body alone.
bool is_quiet(const Model& model, const State& state, const StepperSettings& settings) {
  QuietIslands quiet(model, settings);
  StepIslands islands(model);
  const std::vector<int> bodies = {0};
  islands.connect({}, {});
  quiet.foresee(bodies, islands, state);
  return quiet.contains(0);
}

// The bound on the displacement is the same for every point of a body.
TEST(QuietIslands, no_point_of_a_quiet_body_moves_farther_than_the_tolerance) {
  Model model;
  const int actor = support::add_actor(model, "rod");
  support::add_solid(model, actor, "rod", model::Shape::box, {2, 0.1, 0.3}, 1, {0, 0, 1});
  const StepperSettings settings = settings_with(1e-3);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> number(-1, 1);
  const auto vector = [&] { return model::Vec3(number(random), number(random), number(random)); };
  int num_quiet = 0;
  for (int trial = 0; trial < 20000; ++trial) {
    State state = model::initial_state(model);
    state.velocity[0] = 0.1 * vector();
    state.angular_velocity[0] = 0.1 * vector();
    if (!is_quiet(model, state, settings)) continue;
    ++num_quiet;
    for (const double x : {-1.0, 1.0}) {
      for (const double y : {-0.05, 0.05}) {
        for (const double z : {-0.15, 0.15}) {
          const model::Vec3 speed = state.velocity[0] + state.angular_velocity[0].cross(model::Vec3(x, y, z));
          ASSERT_LE(speed.norm() * settings.dt_s, settings.tolerance_m);
        }
      }
    }
  }
  EXPECT_GT(num_quiet, 100);
}

TEST(QuietIslands, a_state_that_is_no_number_is_not_quiet) {
  Model model;
  const int actor = support::add_actor(model, "box");
  support::add_solid(model, actor, "box", model::Shape::box, {1, 1, 1}, 1, {0, 0, 1});
  State state = model::initial_state(model);
  EXPECT_TRUE(is_quiet(model, state, settings_with(1e-3)));
  state.velocity[0].x() = NAN;
  EXPECT_FALSE(is_quiet(model, state, settings_with(1e-3)));
}

}  // namespace
}  // namespace pbmpi::solver
