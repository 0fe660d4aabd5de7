#include "solver/layout/row_law.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace pbmpi::solver {
namespace {

constexpr double h = 0.00125;  // [s]

/// A body on a line with a row that pulls it to 0, as the sweeps of a substep solve it.
struct Oscillator {
  double position = 0, velocity = 0;  // [m], [m/s]
  double inv_mass = 1;
  double impulse = 0;  // [N s] of the substep

  void sweep(const SpringStep& spring) {
    const RowLaw<double> law = spring.law<double>();
    const double rhs = -spring.erp() * position / h;
    const double change = (rhs - velocity) * law.mass_share / inv_mass - law.relief * impulse;
    impulse += change;
    velocity += inv_mass * change;
  }
};

/// The velocity after an implicit Euler step of x'' = -w^2 x - 2 zeta w x'.
double implicit_euler(const Spring& spring, double position, double velocity) {
  const double w = 2 * std::acos(-1.0) * spring.frequency_hz, zeta = spring.damping_ratio;
  return (velocity - h * w * w * position) / (1 + 2 * zeta * w * h + w * w * h * h);
}

const Spring springs[] = {{1, 0.1}, {5, 1}, {30, 2}, {60, 10}, {100, 2}, {199, 0.5}};

TEST(SpringStep, moves_bodies_of_any_mass_as_an_implicit_euler_step_does) {
  for (const Spring& spring : springs) {
    for (const double inv_mass : {1e-3, 1.0, 1e3}) {
      Oscillator body{0.02, -0.7, inv_mass};
      const double expected = implicit_euler(spring, body.position, body.velocity);
      body.sweep(SpringStep(spring, h));
      EXPECT_NEAR(body.velocity, expected, 1e-14) << spring.frequency_hz << " Hz";  // roundings of 0.7 m/s
    }
  }
}

TEST(SpringStep, is_solved_by_one_sweep_from_whatever_impulse) {
  for (const Spring& spring : springs) {
    const double expected = implicit_euler(spring, 0.02, -0.7);
    Oscillator body{0.02, -0.7, 0.25};
    body.impulse = 3;  // of the substep before, and already applied
    body.velocity += body.inv_mass * body.impulse;
    for (int sweep = 0; sweep < 3; ++sweep) {
      body.sweep(SpringStep(spring, h));
      EXPECT_NEAR(body.velocity, expected, 1e-14) << spring.frequency_hz << " Hz, sweep " << sweep;
    }
  }
}

TEST(SpringStep, is_no_stiffer_than_its_most_periods_a_step) {
  const double infinite = std::numeric_limits<double>::infinity();
  for (const double zeta : {0.1, 1.0, 10.0}) {
    for (const double most : {most_contact_periods, most_place_periods, most_turn_periods}) {
      const SpringStep stiffest({most / h, zeta, 1}, h), below({0.9 * most / h, zeta, most}, h);
      for (const double frequency_hz : {1.1 * most / h, 1e6, infinite}) {
        const SpringStep beyond({frequency_hz, zeta, most}, h);
        EXPECT_DOUBLE_EQ(beyond.erp(), stiffest.erp());
        EXPECT_DOUBLE_EQ(beyond.law<double>().mass_share, stiffest.law<double>().mass_share);
        EXPECT_DOUBLE_EQ(beyond.law<double>().relief, stiffest.law<double>().relief);
      }
      EXPECT_LT(below.erp(), stiffest.erp());
      EXPECT_LT(below.law<double>().mass_share, stiffest.law<double>().mass_share);
    }
  }
}

TEST(SpringStep, that_stands_for_several_is_as_stiff_as_those) {
  const Spring stiffest{std::numeric_limits<double>::infinity(), 2, most_contact_periods};
  const Spring as_number{most_contact_periods / h, 2, 1e9};
  EXPECT_DOUBLE_EQ(stiffest.frequency_in(h), as_number.frequency_hz);
  for (const double steps : {1.0, 2.0, 12.0}) {
    EXPECT_DOUBLE_EQ(SpringStep(stiffest, steps * h, steps).erp(), SpringStep(as_number, steps * h).erp());
    EXPECT_DOUBLE_EQ(SpringStep(stiffest, steps * h, steps).law<double>().relief,
                     SpringStep(as_number, steps * h).law<double>().relief);
  }
}

TEST(SpringStep, comes_to_rest_without_swinging_where_it_is_damped_well) {
  for (const Spring& spring : {Spring{100, 2}, {100, 10}, {1e6, 1}}) {
    Oscillator body{0.01, 0};
    double before_m = body.position;
    for (int step = 0; step < 2000; ++step) {
      body.impulse = 0;
      body.sweep(SpringStep(spring, h));
      body.position += h * body.velocity;
      EXPECT_LE(std::abs(body.position), before_m) << spring.frequency_hz << " Hz, step " << step;
      before_m = std::abs(body.position);
    }
    EXPECT_LT(before_m, 1e-6) << spring.frequency_hz << " Hz";
  }
}

TEST(RowLaw, without_a_spring_is_rigid_and_relaxing_pushes_nothing_out) {
  const RowLaw<double> rigid, relaxing = RowLaw<double>::relaxing();
  for (const RowLaw<double>& law : {rigid, relaxing}) {
    EXPECT_EQ(law.mass_share, 1);
    EXPECT_EQ(law.relief, 0);
  }
  EXPECT_EQ(rigid.bias, 1);
  EXPECT_EQ(relaxing.bias, 0);
  EXPECT_EQ(relaxing.most_push, 0);
}

}  // namespace
}  // namespace pbmpi::solver
