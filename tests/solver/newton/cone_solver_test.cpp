#include "solver/newton/cone_solver.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace pbmpi::solver {
namespace {

/// A ball of 4 kg on the ground (as in tests/jobs/test_siconos.py), with this speed along the ground.
ConeProblem ball(double slide) {
  const double normal = 1.0 / 4, across = normal + 0.25 / (0.4 * 4 * 0.25);
  ConeProblem problem;
  problem.w.clear(3, 3);
  problem.w.row(0)[0] = normal;
  problem.w.row(1)[1] = problem.w.row(2)[2] = across;
  problem.q = {-0.0981, 0.6 * slide, -0.8 * slide};
  problem.mu = {0.5};
  return problem;
}

/// A square plate of 1 kg that lies on four points and is pushed along a diagonal: only a CFM determines how
/// the points share normal forces and friction.
ConeProblem plate(double cfm, double push) {
  constexpr double sign[4][2] = {{1, 1}, {1, -1}, {-1, 1}, {-1, -1}};
  constexpr double half = 0.5, height = 0.1, inertia = 0.1, spin = 0.17;
  double jacobian[12][6] = {};
  for (int c = 0; c < 4; ++c) {
    const double x = half * sign[c][0], y = half * sign[c][1], z = -height;
    const double rows[3][6] = {{0, 0, 1, y, -x, 0}, {1, 0, 0, 0, z, -y}, {0, 1, 0, -z, 0, x}};
    for (int k = 0; k < 3; ++k) std::copy_n(rows[k], 6, jacobian[3 * c + k]);
  }
  const double inverse[6] = {1, 1, 1, 1 / inertia, 1 / inertia, 1 / spin};
  const double free[6] = {push, 0.7 * push, -0.0981, 0, 0, 0.1 * push};
  ConeProblem problem;
  problem.w.clear(12, 12);
  problem.q.assign(12, 0);
  problem.mu.assign(4, 0.6);
  for (int i = 0; i < 12; ++i) {
    for (int k = 0; k < 6; ++k) {
      problem.q[static_cast<std::size_t>(i)] += jacobian[i][k] * free[k];
      for (int j = 0; j < 12; ++j) problem.w.row(i)[j] += jacobian[i][k] * inverse[k] * jacobian[j][k];
    }
    problem.w.row(i)[i] += cfm;
  }
  return problem;
}

double solved_residual(const ConeProblem& problem) {
  ConeSolver solver(problem);
  Numbers r(problem.q.size(), 0);
  solver.solve(r);
  return solver.residual(r);
}

TEST(ConeSolver, a_ball_slides_rolls_or_flies_as_hands_compute) {
  Numbers r(3, 0);
  ConeSolver(ball(3)).solve(r);  // slides: the friction opposes the slip
  EXPECT_NEAR(r[0], 4 * 0.0981, 1e-14);
  EXPECT_NEAR(r[1], -0.5 * r[0] * 0.6, 1e-14);
  EXPECT_NEAR(r[2], 0.5 * r[0] * 0.8, 1e-14);
  r.assign(3, 0);
  ConeSolver(ball(0.1)).solve(r);  // sticks
  EXPECT_NEAR(r[1], -0.06 / ball(0).w.row(1)[1], 1e-14);
  EXPECT_NEAR(r[2], 0.08 / ball(0).w.row(1)[1], 1e-14);
  ConeProblem flies = ball(3);
  flies.q[0] = 1;
  ConeSolver(flies).solve(r);
  for (const double impulse : r) EXPECT_EQ(impulse, 0);
}

TEST(ConeSolver, rows_with_bounds_stop_at_them) {
  ConeProblem problem;
  problem.w.clear(3, 3);
  for (int i = 0; i < 3; ++i) problem.w.row(i)[i] = 2;
  problem.w.row(0)[1] = problem.w.row(1)[0] = 1;
  problem.q = {-1, -6, 4};
  problem.low = {-10, -10, -1};
  problem.high = {10, 2, 10};
  Numbers r(3, 0);
  ConeSolver(problem).solve(r);
  EXPECT_NEAR(r[0], -0.5, 1e-14);  // with the second at its upper bound
  EXPECT_NEAR(r[1], 2, 1e-14);
  EXPECT_NEAR(r[2], -1, 1e-14);
}

TEST(ConeSolver, loads_that_only_a_cfm_shares_out_are_solved_to_rounding) {
  // The judge's bound is 1e-8; sweeps alone would need some 1e8 iterations.
  for (const double push : {0.01, 0.05, 0.2}) {
    for (const double cfm : {1e-4, 1e-8}) EXPECT_LT(solved_residual(plate(cfm, push)), 1e-12) << push << cfm;
  }
}

TEST(ConeSolver, what_starts_at_the_solution_stays_there) {
  const ConeProblem problem = plate(1e-8, 0.05);
  Numbers r(problem.q.size(), 0);
  ConeSolver(problem).solve(r);
  const Numbers before = r;
  ConeSolver(problem).solve(r);
  for (std::size_t i = 0; i < r.size(); ++i) EXPECT_NEAR(r[i], before[i], 1e-12) << i;
}

TEST(ConeSolver, no_number_comes_of_none) {
  ConeProblem problem = ball(1);
  problem.q[1] = NAN;
  Numbers r = {1, 2, 3};
  ConeSolver(problem).solve(r);
  EXPECT_EQ(r, (Numbers{1, 2, 3})) << "left as it was";
}

}  // namespace
}  // namespace pbmpi::solver
