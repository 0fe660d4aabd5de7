/// Worlds whose motion is known.
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "simulation.h"
#include "support/models.h"

namespace pbmpi::mujoco {
namespace {

using model::Model;
using model::Vec3;

constexpr double g = 9.81;

TEST(MujocoMotion, of_a_free_body_is_the_parabola) {
  Simulation simulation(support::free_box());
  simulation.advance(100);
  const double t = 1, part_s = 0.0025;
  // Semi-implicit Euler in MuJoCo's steps: it falls g t h / 2 farther than the parabola. 400 roundings of
  // numbers near 10 stay below 1e-11.
  EXPECT_NEAR(simulation.state().velocity[0].z(), 3 - g * t, 1e-11);
  EXPECT_NEAR(simulation.state().position[0].z(), 10 + 3 * t - g * t * (t + part_s) / 2, 1e-11);
  EXPECT_NEAR(simulation.state().position[0].x(), t, 1e-11);
  EXPECT_NEAR(simulation.state().position[0].y(), 2 * t, 1e-11);
}

TEST(MujocoMotion, of_a_spinning_body_gains_no_energy) {
  Model model = support::free_box();
  model.gravity.setZero();
  model.bodies[0].angular_velocity = {1, 20, 1};
  Simulation simulation(model);
  simulation.advance(1);
  const double before = simulation.energy();
  simulation.advance(500);
  // The implicit integrator removes energy; the explicit one was seen to double such a spin.
  EXPECT_LT(simulation.energy(), before * (1 + 1e-9));
  EXPECT_GT(simulation.energy(), 0.3 * before);
}

/// Period [s] of a pendulum from the times at which it swings through the vertical.
double measured_period(const Model& model, double dt_s) {
  Simulation simulation(model, settings_with(dt_s));
  double first = -1, last = -1, x = simulation.state().position[0].x();
  int crossings = 0;
  for (int step = 1; crossings < 5; ++step) {
    simulation.advance(1);
    const double next = simulation.state().position[0].x();
    if (x * next < 0) {
      const double time = (step - next / (next - x)) * dt_s;
      if (crossings == 0) first = time;
      last = time;
      ++crossings;
    }
    x = next;
  }
  return 2 * (last - first) / (crossings - 1);
}

TEST(MujocoMotion, of_a_pendulum_has_the_period_of_its_closed_form) {
  const double length = 1, angle = 0.1;
  const double radius = 0.3, inertia = 0.4 * radius * radius + length * length;
  const double period = 2 * std::numbers::pi * std::sqrt(inertia / (g * length)) * (1 + angle * angle / 16);
  // The angle's next term is below 1e-7, and that of the step is below (w h)^2.
  EXPECT_NEAR(measured_period(support::pendulum(length, angle), 0.002), period, 1e-4 * period);
}

TEST(MujocoMotion, of_a_chain_keeps_its_joints_closed) {
  Simulation simulation(support::chain(6));
  simulation.advance(200);
  EXPECT_LT(simulation.observables().joint_gap_m, 1e-12) << "joints of a tree cannot open";
  EXPECT_EQ(simulation.observables().nonfinite, 0);
}

TEST(MujocoMotion, of_a_chain_is_that_of_ode_in_fine_steps) {
  const double dt_s = 5e-4;
  const Model model = support::chain(3);
  Simulation simulation(model, settings_with(dt_s));
  Simulation reference = Simulation::by_ode(model, dt_s);
  simulation.advance(1000);
  reference.advance(1000);
  for (int body = 0; body < 3; ++body) {
    // Both are of first order: their difference is proportional to the step, and a few mm after 0.5 s at 0.5
    // ms.
    EXPECT_LT((simulation.state().position[body] - reference.state().position[body]).norm(), 0.01) << body;
  }
}

TEST(MujocoMotion, dies_away_with_damping) {
  Model model = support::free_box();
  model.gravity.setZero();
  model.linear_damping = 0.5;
  Simulation simulation(model);
  simulation.advance(100);
  EXPECT_NEAR(simulation.state().velocity[0].x(), std::exp(-0.5), 1e-12);
}

}  // namespace
}  // namespace pbmpi::mujoco
