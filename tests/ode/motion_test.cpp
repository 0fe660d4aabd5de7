/// Worlds whose motion is known.
#include <cmath>

#include <gtest/gtest.h>

#include "simulation.h"
#include "stepping/stepper_traits.h"
#include "support/models.h"
#include "support/motions.h"

namespace pbmpi::ode {
namespace {

using model::Model;
using model::Vec3;
using stepping::StepperKind;
using stepping::StepperSettings;

constexpr double g = 9.81;

std::string kind_name(const testing::TestParamInfo<StepperKind>& kind) {
  return kind.param == StepperKind::quick ? "quick" : "direct";
}

class Motion : public testing::TestWithParam<StepperKind> {
 protected:
  StepperSettings settings(double dt_s, int iterations = 20) const {
    StepperSettings settings = default_settings(GetParam());
    settings.dt_s = dt_s;
    settings.iterations = iterations;
    return settings;
  }
};

INSTANTIATE_TEST_SUITE_P(BothSteppers, Motion, testing::Values(StepperKind::quick, StepperKind::direct),
                         kind_name);

TEST_P(Motion, of_a_free_body_is_the_parabola_of_semi_implicit_euler) {
  const double h = 0.01;
  const int n = 200;
  Simulation simulation(support::free_box(), settings(h));
  simulation.advance(n);
  const double t = n * h;
  // v_n = v_0 - g h n and x_n = x_0 + h sum(v_k), exactly; 200 roundings of numbers near 20 stay below 1e-11.
  EXPECT_NEAR(simulation.state().velocity[0].z(), 3 - g * t, 1e-11);
  EXPECT_NEAR(simulation.state().position[0].z(), 10 + 3 * t - g * h * h * n * (n + 1) / 2, 1e-11);
  EXPECT_NEAR(simulation.state().position[0].x(), t, 1e-11);
  EXPECT_NEAR(simulation.state().position[0].y(), 2 * t, 1e-11);
}

TEST_P(Motion, of_a_free_spinning_body_keeps_its_angular_momentum) {
  Model model = support::free_box();
  Simulation simulation(model, settings(0.001));
  const auto momentum = [&](const model::Quat& q, const Vec3& omega) -> Vec3 {
    const Eigen::Matrix3d turn = q.to_eigen().toRotationMatrix();
    return turn * model.bodies[0].inertia * turn.transpose() * omega;
  };
  const Vec3 before = momentum(model.bodies[0].pose.orientation, model.bodies[0].angular_velocity);
  simulation.advance(1000);
  const Vec3 after = momentum(simulation.state().orientation[0], simulation.state().angular_velocity[0]);
  // First-order integration: the error is proportional to dt |omega| = 0.002. Without gyroscopic torque omega
  // would stay constant and L would turn with the body: an error near 1.
  EXPECT_LT((after - before).norm() / before.norm(), 0.01);
  EXPECT_GT((simulation.state().angular_velocity[0] - model.bodies[0].angular_velocity).norm(), 0.1);
}

TEST_P(Motion, of_a_box_on_the_ground_is_rest) {
  Simulation simulation(support::box_over_ground(0), settings(0.01));
  simulation.advance(300);
  // The contact sinks until ERP 0.2 per step balances g h: below g h^2 / ERP = 5 mm; here four points share
  // this.
  EXPECT_NEAR(simulation.state().position[0].z(), 0.5, 0.005);
  EXPECT_LT(simulation.state().velocity[0].norm(), 1e-3);
  EXPECT_EQ(simulation.observables().contacts, 4);
  EXPECT_LT(simulation.observables().max_penetration_m, 0.005);
}

TEST_P(Motion, of_a_sliding_box_stops_where_coulomb_says) {
  Model model = support::box_over_ground(0);
  model.geoms[0].material.mu = 0.8;
  model.geoms[1].material.mu = 0.2;  // mu = sqrt(0.16) = 0.4
  model.bodies[0].velocity = {4, 0, 0};
  Simulation simulation(model, settings(0.002, 100));
  simulation.advance(1500);
  // v^2 / (2 mu g) = 2.04 m. The normal force, which bounds friction, is exact only on average (iterations);
  // direct leaves some of the redundant rows unsolved and reports it ("LCP internal error").
  const double share = GetParam() == StepperKind::quick ? 0.05 : 0.15;
  EXPECT_NEAR(simulation.state().position[0].x(), 16 / (2 * 0.4 * g), share * 2.04);
  EXPECT_LT(simulation.state().velocity[0].norm(), 1e-3);
}

TEST_P(Motion, of_a_smooth_box_never_stops) {
  Model model = support::box_over_ground(0);
  for (model::Geom& geom : model.geoms) geom.material.mu = 0;
  model.bodies[0].velocity = {4, 0, 0};
  Simulation simulation(model, settings(0.01));
  simulation.advance(100);
  EXPECT_NEAR(simulation.state().velocity[0].x(), 4, 1e-9);  // no row acts along x
  EXPECT_EQ(simulation.observables().rows, 4);               // one per contact
}

TEST_P(Motion, of_an_elastic_ball_comes_back_with_the_restitution) {
  Simulation simulation(support::elastic_ball(), settings(0.001));
  // It falls 1 m and rises 0.64 m; the impact is detected up to v dt = 4.4 mm late, in either direction.
  EXPECT_NEAR(support::highest_after_bounce(simulation) - 0.1, 0.64, 0.01);
}

TEST_P(Motion, of_a_hinge_pendulum_has_the_period_of_theory) {
  const double h = 0.001;
  const double length = 1;
  const double angle = 0.2;
  Simulation simulation(support::pendulum(length, angle), settings(h, 50));
  const double theory = support::period_in_theory(simulation.model(), length, angle);
  // A first-order step of 1 ms in a period of 2 s: 0.1 %.
  EXPECT_NEAR(support::period_of(simulation, h), theory, 1e-3 * theory);
  EXPECT_LT(simulation.observables().joint_gap_m, 1e-5);
}

TEST_P(Motion, of_a_hanging_chain_keeps_it_together) {
  Simulation simulation(support::chain(8), settings(0.002, 50));
  for (int frame = 0; frame < 50; ++frame) {
    simulation.advance(10);
    // The free end falls at up to 9 m/s: the error of the linearised joint is some (v h)^2 / length = 0.6 mm,
    // and 50 iterations leave more.
    EXPECT_LT(simulation.observables().joint_gap_m, 0.02);
  }
}

TEST(Steppers, agree_on_a_smooth_world) {
  const Model model = support::pendulum(1, 0.5);
  Simulation quick(model, {StepperKind::quick, 0.005, 200, 1});
  Simulation direct(model, {StepperKind::direct, 0.005, 1, 1});
  quick.advance(400);
  direct.advance(400);
  // 200 sweeps solve the five rows of one hinge to rounding; 400 steps accumulate it.
  EXPECT_LT((quick.state().position[0] - direct.state().position[0]).norm(), 1e-6);
}

TEST(Steppers, agree_on_a_ball_that_comes_to_rest) {
  Model model;
  support::add_ground(model);
  const int actor = support::add_actor(model, "ball");
  support::add_solid(model, actor, "ball", model::Shape::sphere, {0.3, 0, 0}, 2, {0, 0, 0.5});
  model.bodies[0].velocity = {1, 0, 0};
  Simulation quick(model, {StepperKind::quick, 0.005, 200, 1});
  Simulation direct(model, {StepperKind::direct, 0.005, 1, 1});
  quick.advance(400);
  direct.advance(400);
  // One contact at most, thus one solution. Friction at the landing is bounded by a normal force that quick
  // knows only after its sweeps: 1 mm over a path of 2 m.
  EXPECT_LT((quick.state().position[0] - direct.state().position[0]).norm(), 1e-3);
  EXPECT_GT(direct.state().position[0].x(), 1);
}

}  // namespace
}  // namespace pbmpi::ode
