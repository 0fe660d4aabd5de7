/// MuJoCo's constraint solver, and its integrator.
#include <gtest/gtest.h>

#include "model/state.h"
#include "mujoco/compiled.h"
#include "simulation.h"
#include "support/models.h"

namespace pbmpi::mujoco {
namespace {

using model::Model;

stepping::StepperSettings settings_of(int iterations) {
  stepping::StepperSettings settings = settings_with();
  settings.iterations = iterations;
  return settings;
}

TEST(MujocoSolver, is_newtons_and_the_integrator_is_the_implicit_one) {
  const MessageScope scope;
  const Compiled compiled(support::crash(), {}, settings_of(37), true);
  EXPECT_EQ(compiled.engine.model().opt.solver, mjSOL_NEWTON);
  EXPECT_EQ(compiled.engine.model().opt.iterations, 37);
  EXPECT_EQ(compiled.engine.model().opt.integrator, mjINT_IMPLICIT);
}

TEST(MujocoSolver, takes_at_most_so_many_iterations) {
  Simulation simulation(support::pile(6), settings_of(3));
  double most = 0;
  for (int step = 0; step < 60; ++step) {
    simulation.advance(1);
    const stepping::Observables& seen = simulation.observables();
    EXPECT_EQ(seen.nonfinite, 0);
    if (seen.rows > 0) most = std::max(most, seen.row_visits / seen.rows);
  }
  EXPECT_EQ(most, 3);
}

TEST(MujocoSolver, starts_from_the_state_alone) {
  const Model model = support::crash();
  Simulation simulation(model, settings_of(100));
  simulation.advance(15);
  Simulation whole(model, settings_of(100));
  whole.advance(30);
  Simulation rest(model, settings_of(100));
  rest.stepper().set_state(0, simulation.state(), 15);
  rest.advance(15);
  EXPECT_EQ(model::hash(rest.state()), model::hash(whole.state()));
}

}  // namespace
}  // namespace pbmpi::mujoco
