/// MuJoCo's constraint solvers, and its integrator.
#include <gtest/gtest.h>

#include <array>

#include "model/state.h"
#include "mujoco/compiled.h"
#include "simulation.h"
#include "stepping/names.h"
#include "support/models.h"

namespace pbmpi::mujoco {
namespace {

using model::Model;
using stepping::ConstraintSolver;

constexpr std::array solvers = {ConstraintSolver::newton, ConstraintSolver::pgs, ConstraintSolver::cg};

stepping::StepperSettings settings_of(ConstraintSolver solver, int iterations = 100) {
  stepping::StepperSettings settings = settings_with();
  settings.constraint_solver = solver;
  settings.iterations = iterations;
  return settings;
}

model::State state_after(const Model& model, const stepping::StepperSettings& settings, int num_steps) {
  Simulation simulation(model, settings);
  simulation.advance(num_steps);
  return simulation.state();
}

/// [m] Distance of the body that is farthest off.
double distance(const model::State& a, const model::State& b) {
  double most = 0;
  for (std::size_t body = 0; body < a.position.size(); ++body)
    most = std::max(most, (a.position[body] - b.position[body]).norm());
  return most;
}

TEST(MujocoSolvers, are_those_that_the_settings_name_and_the_integrator_is_the_implicit_one) {
  const Model model = support::crash();
  const std::array mujocos = {mjSOL_NEWTON, mjSOL_PGS, mjSOL_CG};
  for (std::size_t i = 0; i < solvers.size(); ++i) {
    const MessageScope scope;
    const Compiled compiled(model, {}, settings_of(solvers[i], 37), true);
    EXPECT_EQ(compiled.engine.model().opt.solver, mujocos[i]) << name_of(solvers[i]);
    EXPECT_EQ(compiled.engine.model().opt.iterations, 37);
    EXPECT_EQ(compiled.engine.model().opt.integrator, mjINT_IMPLICIT);
  }
}

TEST(MujocoSolvers, find_the_solution_of_one_problem) {
  // All of them minimise one convex cost. The residuals within MuJoCo's tolerance of 1e-8 add up to some
  // micrometres in these steps. Where boxes tumble or slide for longer, Gauss-Seidel stops millimetres away:
  // its sweeps improve too little.
  struct Case {
    Model model;
    int num_steps;
  };
  const Case cases[] = {{support::box_over_ground(0), 40}, {support::pile(1), 40}, {support::crash(), 10}};
  for (const auto& [model, num_steps] : cases) {
    const model::State newton = state_after(model, settings_of(ConstraintSolver::newton), num_steps);
    for (const ConstraintSolver solver : {ConstraintSolver::pgs, ConstraintSolver::cg})
      EXPECT_LT(distance(newton, state_after(model, settings_of(solver, 5000), num_steps)), 1e-5)
          << name_of(solver);
  }
}

TEST(MujocoSolvers, take_at_most_so_many_iterations) {
  const Model model = support::pile(6);
  for (const ConstraintSolver solver : solvers) {
    Simulation simulation(model, settings_of(solver, 3));
    double most = 0;
    for (int step = 0; step < 60; ++step) {
      simulation.advance(1);
      const stepping::Observables& seen = simulation.observables();
      EXPECT_EQ(seen.nonfinite, 0);
      if (seen.rows > 0) most = std::max(most, seen.row_visits / seen.rows);
    }
    EXPECT_EQ(most, 3) << name_of(solver);
  }
}

TEST(MujocoSolvers, start_from_the_state_alone) {
  const Model model = support::crash();
  for (const ConstraintSolver solver : solvers) {
    Simulation simulation(model, settings_of(solver));
    simulation.advance(15);
    Simulation whole(model, settings_of(solver));
    whole.advance(30);
    Simulation rest(model, settings_of(solver));
    rest.stepper().set_state(0, simulation.state(), 15);
    rest.advance(15);
    EXPECT_EQ(model::hash(rest.state()), model::hash(whole.state())) << name_of(solver);
  }
}

}  // namespace
}  // namespace pbmpi::mujoco
