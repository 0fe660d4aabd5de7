#include "estimate/partly_precise.h"

#include <gtest/gtest.h>

#include "estimate/same_solve.h"
#include "estimate/short_run.h"
#include "estimate/until_due.h"
#include "ode/collide/narrow_phase.h"
#include "ode/ode_stepper.h"
#include "solver/worlds/sor_stepper.h"
#include "stability/guarded_stepper.h"
#include "stepping/glide.h"
#include "stepping/stepper_traits.h"
#include "support/models.h"

namespace pbmpi::estimate {
namespace {

constexpr int steps_per_frame = 3;

stepping::StepperSettings settings_of(stepping::StepperKind kind, int iterations) {
  stepping::StepperSettings settings = default_settings(kind, stepping::Law::ode);
  settings.iterations = iterations;
  return settings;
}

std::unique_ptr<stepping::WorldStepper> stepper_of(stepping::StepperKind kind, int iterations) {
  const stepping::StepperSettings settings = settings_of(kind, iterations);
  if (kind == stepping::StepperKind::sor) return solver::make_sor_stepper(settings, ode::make_narrow_phase);
  return ode::make_ode_stepper(settings, [](const std::string&) {});
}

std::unique_ptr<stability::GuardedStepper> frames_of(stepping::StepperKind kind, int iterations) {
  auto frames =
      std::make_unique<stability::GuardedStepper>(stepper_of(kind, iterations), stability::GuardSettings());
  for (int world = 0; world < 3; ++world) {
    const auto model = std::make_shared<const model::Model>(support::crash(world));
    frames->add(world, model, model::initial_state(*model), 0);
  }
  return frames;
}

std::vector<stepping::LocalWorld> views(const stepping::WorldStepper& stepper) {
  std::vector<stepping::LocalWorld> worlds;
  for (int world = 0; world < 3; ++world)
    worlds.push_back({world, &stepper.model(world), &stepper.state(world), nullptr});
  return worlds;
}

std::vector<std::uint64_t> hashes(const stepping::Estimator& estimator) {
  std::vector<std::uint64_t> found;
  for (int world = 0; world < 3; ++world) found.push_back(model::hash(estimator.state(world)));
  return found;
}

std::vector<std::uint64_t> hashes(const stepping::WorldStepper& stepper) {
  std::vector<std::uint64_t> found;
  for (int world = 0; world < 3; ++world) found.push_back(model::hash(stepper.state(world)));
  return found;
}

class PartlyPreciseOf : public testing::TestWithParam<stepping::StepperKind> {};
INSTANTIATE_TEST_SUITE_P(steppers, PartlyPreciseOf,
                         testing::Values(stepping::StepperKind::quick, stepping::StepperKind::sor));

TEST_P(PartlyPreciseOf, begins_the_frame_and_leaves_its_result_alone) {
  core::PhaseTimes times;
  for (int after = 0; after < steps_per_frame; ++after) {
    const auto precise = frames_of(GetParam(), 20), alone = frames_of(GetParam(), 20),
               by_hand = frames_of(GetParam(), 20);
    PartlyPrecise partly(*precise, std::make_unique<ShortRun>(stepper_of(GetParam(), 1)), after);
    ShortRun rest(stepper_of(GetParam(), 1));
    for (std::int64_t step = 0; step < 12; step += steps_per_frame) {
      const auto before = hashes(*precise);
      partly.estimate(views(*precise), step, steps_per_frame, times);
      EXPECT_EQ(hashes(*precise), before) << "the frame is not over";
      EXPECT_EQ(partly.steps().precise, after);
      EXPECT_EQ(partly.steps().coarse, steps_per_frame - after);
      if (after > 0) by_hand->advance(after, times);
      rest.estimate(views(*by_hand), step + after, steps_per_frame - after, times);
      EXPECT_EQ(hashes(partly), hashes(rest)) << "after " << after << " steps, at step " << step;
      by_hand->advance(steps_per_frame - after, times);
      precise->advance(steps_per_frame, times);
      alone->advance(steps_per_frame, times);
      EXPECT_EQ(hashes(*precise), hashes(*alone)) << "after " << after << " steps, at step " << step;
      for (int world = 0; world < 3; ++world) EXPECT_GT(precise->cost_s(world), 0);
    }
  }
}

TEST(PartlyPrecise, may_look_into_the_solve_of_the_last_step) {
  core::PhaseTimes times;
  const auto precise = frames_of(stepping::StepperKind::sor, 20),
             alone = frames_of(stepping::StepperKind::sor, 20);
  PartlyPrecise partly(*precise, std::make_unique<SameSolve>(*precise, 20), 2);
  for (std::int64_t step = 0; step < 12; step += steps_per_frame) {
    partly.estimate(views(*precise), step, steps_per_frame, times);
    precise->advance(steps_per_frame, times);
    alone->advance(steps_per_frame, times);
    EXPECT_EQ(hashes(*precise), hashes(*alone));
    for (int world = 0; world < 3; ++world) {
      EXPECT_EQ(partly.state(world).position[0], precise->state(world).position[0])
          << "all iterations: the result";
    }
  }
}

TEST(UntilDue, sends_the_precise_result_where_there_is_time_and_motion_without_forces_where_there_is_none) {
  core::PhaseTimes times;
  for (const double deadline_s : {1000.0, 1e-9}) {
    const auto precise = frames_of(stepping::StepperKind::sor, 20),
               alone = frames_of(stepping::StepperKind::sor, 20);
    UntilDue due(*precise, std::make_unique<ShortRun>(stepper_of(stepping::StepperKind::sor, 1)), deadline_s,
                 0.01);
    for (std::int64_t step = 0; step < 12; step += steps_per_frame) {
      model::State glided = precise->state(1);
      stepping::glide(0.03, glided);
      due.estimate(views(*precise), step, steps_per_frame, times);
      const auto estimated = hashes(due);
      precise->advance(steps_per_frame, times);
      alone->advance(steps_per_frame, times);
      EXPECT_EQ(hashes(*precise), hashes(*alone));
      EXPECT_EQ(hashes(due), estimated) << "an estimate stays as it is";
      if (deadline_s > 1) {
        EXPECT_EQ(due.steps().precise, steps_per_frame);
        EXPECT_NE(&due.state(1), &precise->begun(1)) << "a guard may take the world from there";
        EXPECT_EQ(due.state(1).position, precise->state(1).position);
      } else {
        EXPECT_EQ(due.steps().precise + due.steps().coarse, 0);
        EXPECT_EQ(due.state(1).position, glided.position);
        EXPECT_NE(due.state(1).position, precise->state(1).position);
      }
    }
  }
}

}  // namespace
}  // namespace pbmpi::estimate
