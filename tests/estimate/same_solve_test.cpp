#include "estimate/same_solve.h"

#include <gtest/gtest.h>

#include "estimate/short_run.h"
#include "ode/collide/narrow_phase.h"
#include "solver/worlds/sor_stepper.h"
#include "stepping/stepper_traits.h"
#include "support/models.h"

namespace pbmpi::estimate {
namespace {

std::unique_ptr<stepping::AnytimeStepper> sor(int iterations) {
  stepping::StepperSettings settings = default_settings(stepping::StepperKind::sor, stepping::Law::ode);
  settings.iterations = iterations;
  return solver::make_sor_stepper(settings, ode::make_narrow_phase);
}

void add_crashes(stepping::WorldStepper& stepper) {
  for (int world = 0; world < 3; ++world) {
    const auto model = std::make_shared<const model::Model>(support::crash(world));
    stepper.add(world, model, model::initial_state(*model), 0);
  }
}

std::vector<stepping::LocalWorld> views(const stepping::WorldStepper& stepper) {
  std::vector<stepping::LocalWorld> worlds;
  for (int world = 0; world < 3; ++world)
    worlds.push_back({world, &stepper.model(world), &stepper.state(world), nullptr});
  return worlds;
}

TEST(SameSolve, estimates_what_a_short_run_of_so_many_iterations_does_and_leaves_the_precise_run_alone) {
  core::PhaseTimes times;
  const auto precise = sor(20), alone = sor(20), beside = sor(20);
  for (const auto& stepper : {&precise, &alone, &beside}) add_crashes(**stepper);
  SameSolve same(*precise, 3);
  ShortRun own(sor(3));
  int differences = 0;
  for (std::int64_t step = 0; step < 20; ++step) {
    same.estimate(views(*precise), step, 1, times);
    own.estimate(views(*beside), step, 1, times);
    for (int world = 0; world < 3; ++world)
      EXPECT_EQ(model::hash(same.state(world)), model::hash(own.state(world))) << "step " << step;
    for (const auto& stepper : {&precise, &alone, &beside}) (*stepper)->advance(1, times);
    for (int world = 0; world < 3; ++world) {
      EXPECT_EQ(model::hash(precise->state(world)), model::hash(alone->state(world))) << "step " << step;
      differences += model::hash(same.state(world)) != model::hash(precise->state(world)) ? 1 : 0;
    }
  }
  EXPECT_EQ(differences, 60) << "three iterations are not twenty";
}

TEST(SameSolve, a_rank_without_worlds_has_nothing_to_estimate) {
  core::PhaseTimes times;
  const auto precise = sor(20);
  SameSolve same(*precise, 1);
  same.estimate({}, 0, 1, times);
  add_crashes(*precise);
  same.estimate(views(*precise), 0, 1, times);
  EXPECT_NO_THROW(same.state(2));
}

TEST(SameSolve, frames_of_several_steps_are_refused) {
  core::PhaseTimes times;
  const auto precise = sor(20);
  add_crashes(*precise);
  SameSolve same(*precise, 1);
  EXPECT_ANY_THROW(same.estimate(views(*precise), 0, 3, times));
}

}  // namespace
}  // namespace pbmpi::estimate
