#include "estimate/short_run.h"

#include <gtest/gtest.h>

#include <limits>

#include "ode/collide/narrow_phase.h"
#include "ode/ode_stepper.h"
#include "solver/worlds/sor_stepper.h"
#include "stepping/names.h"
#include "stepping/stepper_traits.h"
#include "support/models.h"

namespace pbmpi::estimate {
namespace {

using stepping::StepperKind;

std::unique_ptr<stepping::WorldStepper> make(StepperKind kind, int iterations) {
  stepping::StepperSettings settings = default_settings(kind, stepping::Law::ode);
  settings.iterations = iterations;
  if (kind == StepperKind::sor) return solver::make_sor_stepper(settings, ode::make_narrow_phase);
  return ode::make_ode_stepper(settings, [](const std::string&) {});
}

/// A crash with an event in mid-run: a motor that starts, so that the joints' settings depend on the step.
std::shared_ptr<const model::Model> crash_with_motor(int variant) {
  model::Model model = support::crash(variant);
  for (std::size_t j = 0; j < model.joints.size(); ++j) {
    if (model.joints[j].kind != model::JointKind::hinge2) continue;
    model::Event event;
    event.step = 7;
    event.kind = model::EventKind::motor;
    event.joint = static_cast<int>(j);
    event.axis = 1;
    event.motor = {40, 500};
    model.events.push_back(event);
  }
  return std::make_shared<const model::Model>(std::move(model));
}

std::string name_of_case(const testing::TestParamInfo<StepperKind>& info) {
  return std::string(name_of(info.param));
}

class SetState : public testing::TestWithParam<StepperKind> {};
INSTANTIATE_TEST_SUITE_P(steppers, SetState,
                         testing::Values(StepperKind::quick, StepperKind::direct, StepperKind::sor),
                         name_of_case);

TEST_P(SetState, goes_on_bit_for_bit_at_the_same_step_and_back_in_time) {
  core::PhaseTimes times;
  const auto keeper = make(GetParam(), 20), follower = make(GetParam(), 20);
  for (int world = 0; world < 3; ++world) {
    const auto model = crash_with_motor(world);
    keeper->add(world, model, model::initial_state(*model), 0);
    follower->add(world, model, model::initial_state(*model), 0);
  }
  keeper->advance(6, times);
  const model::State at_6 = keeper->state(1);
  follower->advance(6, times);
  model::State elsewhere = at_6;
  for (auto& position : elsewhere.position) position.z() += 0.1;
  follower->set_state(1, elsewhere, 6);
  follower->advance(3, times);
  ASSERT_NE(model::hash(follower->state(1)), model::hash(at_6));

  follower->set_state(1, at_6, 6);  // back to before the event at step 7
  follower->set_state(0, keeper->state(0), 6);
  follower->set_state(2, keeper->state(2), 6);
  EXPECT_EQ(model::hash(follower->state(1)), model::hash(at_6));
  keeper->advance(6, times);
  follower->advance(6, times);
  for (int world = 0; world < 3; ++world) {
    EXPECT_EQ(model::hash(follower->state(world)), model::hash(keeper->state(world))) << "world " << world;
  }
}

TEST_P(SetState, brings_a_lost_world_back) {
  core::PhaseTimes times;
  const auto stepper = make(GetParam(), 20);
  const auto model = crash_with_motor(0);
  const model::State start = model::initial_state(*model);
  stepper->add(0, model, start, 0);
  stepper->advance(3, times);
  const auto expected = model::hash(stepper->state(0));
  model::State broken = start;
  broken.velocity[0].x() = std::numeric_limits<double>::quiet_NaN();
  stepper->set_state(0, broken, 0);
  stepper->advance(3, times);
  EXPECT_GT(stepper->observables(0).nonfinite, 0);
  stepper->set_state(0, start, 0);
  stepper->advance(3, times);
  EXPECT_EQ(model::hash(stepper->state(0)), expected);
}

TEST(ShortRun, follows_the_worlds_that_come_and_go) {
  core::PhaseTimes times;
  const auto precise = make(StepperKind::quick, 20);
  ShortRun estimator(make(StepperKind::quick, 20));
  const auto views = [&](std::vector<int> ids) {
    std::vector<stepping::LocalWorld> worlds;
    for (const int id : ids) worlds.push_back({id, &precise->model(id), &precise->state(id), nullptr});
    return worlds;
  };
  const auto expect_equal = [&](std::vector<int> ids, std::int64_t step) {
    estimator.estimate(views(ids), step, 3, times);
    std::vector<std::uint64_t> estimated;
    for (const int id : ids) estimated.push_back(model::hash(estimator.state(id)));
    precise->advance(3, times);
    for (std::size_t i = 0; i < ids.size(); ++i) {
      EXPECT_EQ(estimated[i], model::hash(precise->state(ids[i])))
          << "world " << ids[i] << " at step " << step;
    }
  };
  for (const int world : {0, 2}) {
    const auto model = crash_with_motor(world);
    precise->add(world, model, model::initial_state(*model), 0);
  }
  expect_equal({0, 2}, 0);
  precise->remove(0);
  expect_equal({2}, 3);
  const auto model = crash_with_motor(1);
  precise->add(1, model, model::initial_state(*model), 6);
  expect_equal({1, 2}, 6);
}

TEST(ShortRun, fewer_iterations_give_another_result_and_leave_the_precise_one_alone) {
  core::PhaseTimes times;
  const auto precise = make(StepperKind::quick, 20), alone = make(StepperKind::quick, 20);
  const auto model = crash_with_motor(0);
  for (const auto& stepper : {&precise, &alone}) (*stepper)->add(0, model, model::initial_state(*model), 0);
  ShortRun estimator(make(StepperKind::quick, 1));
  for (std::int64_t step = 0; step < 12; step += 3) {
    const std::vector<stepping::LocalWorld> worlds = {{0, &precise->model(0), &precise->state(0), nullptr}};
    estimator.estimate(worlds, step, 3, times);
    precise->advance(3, times);
    alone->advance(3, times);
    EXPECT_NE(model::hash(estimator.state(0)), model::hash(precise->state(0)));
    EXPECT_EQ(model::hash(precise->state(0)), model::hash(alone->state(0)));
  }
}

}  // namespace
}  // namespace pbmpi::estimate
