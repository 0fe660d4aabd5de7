#include <cmath>

#include <gtest/gtest.h>

#include "simulation.h"
#include "support/models.h"
#include "support/motions.h"

namespace pbmpi::bullet {
namespace {

using model::Model;
using model::Vec3;

constexpr double g = 9.81;

TEST(Motion, of_a_free_body_is_the_parabola_of_semi_implicit_euler) {
  const double h = 0.01;
  const int n = 200;
  Simulation simulation(support::free_box(), settings_of(h, 10));
  simulation.advance(n);
  const double t = n * h;
  // v_n = v_0 - g h n and x_n = x_0 + h sum(v_k), exactly; 200 roundings of numbers near 20 stay below 1e-11.
  EXPECT_NEAR(simulation.state().velocity[0].z(), 3 - g * t, 1e-11);
  EXPECT_NEAR(simulation.state().position[0].z(), 10 + 3 * t - g * h * h * n * (n + 1) / 2, 1e-11);
  EXPECT_NEAR(simulation.state().position[0].x(), t, 1e-11);
}

Vec3 momentum(const Model& model, const model::State& state) {
  const Eigen::Matrix3d turn = state.orientation[0].to_eigen().toRotationMatrix();
  return turn * model.bodies[0].inertia * turn.transpose() * state.angular_velocity[0];
}

TEST(Motion, of_a_free_spinning_body_keeps_its_angular_momentum) {
  Model model = support::free_box();
  Model turned = model;  // the same body in a frame that is not that of its principal axes
  const Eigen::Quaterniond frame(Eigen::AngleAxisd(0.7, Vec3(1, 2, -1).normalized()));
  turned.bodies[0].inertia = frame.conjugate() * model.bodies[0].inertia * frame.toRotationMatrix();
  turned.bodies[0].inertia = (turned.bodies[0].inertia + turned.bodies[0].inertia.transpose()).eval() / 2;
  turned.bodies[0].pose.orientation =
      model::Quat::from_eigen((model.bodies[0].pose.orientation.to_eigen() * frame).normalized());
  Vec3 spin = Vec3::Zero();
  for (const Model& one : {model, turned}) {
    const Vec3 before = momentum(one, model::initial_state(one));
    Simulation simulation(one, settings_of(0.001, 10));
    simulation.advance(1000);
    const Vec3 after = momentum(one, simulation.state());
    // First-order integration: the error is proportional to dt |omega| = 0.002. Without gyroscopic torque
    // omega would stay constant and L would turn with the body: an error near 1.
    EXPECT_LT((after - before).norm() / before.norm(), 0.01);
    EXPECT_GT((simulation.state().angular_velocity[0] - one.bodies[0].angular_velocity).norm(), 0.1);
    if (&one != &model && spin.norm() > 0) {
      // The two represent one body; their numbers differ by rounding, over 1000 steps.
      EXPECT_LT((simulation.state().angular_velocity[0] - spin).norm(), 1e-9);
    }
    spin = simulation.state().angular_velocity[0];
  }
}

TEST(Motion, of_a_box_on_the_ground_is_rest) {
  Simulation simulation(support::box_over_ground(0), settings_of(0.01, 10));
  simulation.advance(300);
  // The contact sinks until ERP 0.2 per step balances g h: below g h^2 / ERP = 5 mm.
  EXPECT_NEAR(simulation.state().position[0].z(), 0.5, 0.005);
  EXPECT_LT(simulation.state().velocity[0].norm(), 1e-3);
  EXPECT_EQ(simulation.observables().contacts, 4);
  EXPECT_EQ(simulation.observables().rows, 12);
  EXPECT_LT(simulation.observables().max_penetration_m, 0.005);
}

TEST(Motion, of_a_sliding_box_stops_where_coulomb_says) {
  Model model = support::box_over_ground(0);
  model.geoms[0].material.mu = 0.8;
  model.geoms[1].material.mu = 0.2;  // mu = sqrt(0.16) = 0.4
  model.bodies[0].velocity = {4, 0, 0};
  Simulation simulation(model, settings_of(0.002, 100));
  simulation.advance(1500);
  EXPECT_NEAR(simulation.state().position[0].x(), 16 / (2 * 0.4 * g), 0.05 * 2.04);
  EXPECT_LT(simulation.state().velocity[0].norm(), 1e-3);
}

TEST(Motion, of_a_smooth_box_never_stops) {
  Model model = support::box_over_ground(0);
  for (model::Geom& geom : model.geoms) geom.material.mu = 0;
  model.bodies[0].velocity = {4, 0, 0};
  Simulation simulation(model, settings_of(0.01, 10));
  simulation.advance(100);
  EXPECT_NEAR(simulation.state().velocity[0].x(), 4, 1e-9);  // friction rows are bounded by zero
  EXPECT_EQ(simulation.observables().rows, 4);               // one per contact
}

/// Distance [m] that a cube of 1 m slides on ground with this `slope` [rad]; gravity is turned instead of the
/// ground.
double slid_m(double slope, double mu) {
  Model model = support::box_over_ground(0);
  for (model::Geom& geom : model.geoms) geom.material.mu = mu;
  model.gravity = {g * std::sin(slope), 0, -g * std::cos(slope)};
  Simulation simulation(model, settings_of(0.005, 50));
  simulation.advance(400);
  return simulation.state().position[0].x();
}

TEST(Motion, of_a_box_on_a_slope_is_sliding_or_rest_as_its_friction_says) {
  const double slope = std::atan(0.5);
  EXPECT_LT(slid_m(slope, 0.55), 0.02);  // 10 % above the friction that holds it
  // 2 s at g (sin - mu cos): 0.05 g cos(slope).
  EXPECT_NEAR(slid_m(slope, 0.45), 0.5 * 0.05 * g * std::cos(slope) * 4, 0.1);
}

TEST(Motion, of_an_elastic_ball_comes_back_with_the_restitution) {
  Simulation simulation(support::elastic_ball(), settings_of(0.001, 10));
  // It falls 1 m and rises 0.64 m; the impact is detected up to v dt = 4.4 mm late, in either direction.
  EXPECT_NEAR(support::highest_after_bounce(simulation) - 0.1, 0.64, 0.015);
}

TEST(Motion, of_a_slow_ball_does_not_bounce) {
  Model model;
  support::add_ground(model);
  model.geoms[0].material.restitution = 1;
  const int actor = support::add_actor(model, "ball");
  support::add_solid(model, actor, "ball", model::Shape::sphere, {0.1, 0, 0}, 1, {0, 0, 0.1});
  model.bodies[0].velocity = {0, 0, -0.05};  // below ContactLaw::bounce_velocity
  Simulation simulation(model, settings_of(0.001, 10));
  simulation.advance(200);
  EXPECT_LT(simulation.state().position[0].z(), 0.1005);
}

TEST(Motion, of_a_hinge_pendulum_has_the_period_of_theory) {
  const double h = 0.001, length = 1, angle = 0.2;
  Simulation simulation(support::pendulum(length, angle), settings_of(h, 50));
  const double theory = support::period_in_theory(simulation.model(), length, angle);
  // A first-order step of 1 ms in a period of 2 s: 0.1 %.
  EXPECT_NEAR(support::period_of(simulation, h), theory, 1e-3 * theory);
  EXPECT_LT(simulation.observables().joint_gap_m, 1e-4);
}

TEST(Motion, of_a_hanging_chain_keeps_it_together) {
  Simulation simulation(support::chain(8), settings_of(0.002, 50));
  for (int frame = 0; frame < 50; ++frame) {
    simulation.advance(10);
    // The free end falls at up to 9 m/s: the error of the linearised joint is some (v h)^2 / length = 0.6 mm,
    // and 50 iterations leave more.
    EXPECT_LT(simulation.observables().joint_gap_m, 0.02);
  }
}

TEST(Motion, dies_away_with_the_models_damping) {
  Model model = support::free_box();
  model.gravity.setZero();
  model.linear_damping = 0.5;
  model.angular_damping = 40;  // Bullet's own damping ends at 1
  Simulation simulation(model, settings_of(0.01, 10));
  simulation.advance(100);
  EXPECT_NEAR(simulation.state().velocity[0].z(), 3 * std::exp(-0.5), 1e-12);
  EXPECT_LT(simulation.state().angular_velocity[0].norm(), 1e-15);
}

}  // namespace
}  // namespace pbmpi::bullet
