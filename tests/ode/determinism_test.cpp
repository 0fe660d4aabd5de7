/// A world's bits depend only on its model, state, step number and settings.
#include <functional>

#include <gtest/gtest.h>

#include "ode/ode_stepper.h"
#include "simulation.h"
#include "stepping/stepper_traits.h"
#include "support/models.h"
#include "support/motions.h"

namespace pbmpi::ode {
namespace {

using model::Model;
using model::State;
using stepping::StepperKind;
using stepping::StepperSettings;
using stepping::WorldStepper;

std::unique_ptr<WorldStepper> make_stepper(const StepperSettings& settings) {
  // ODE's big-matrix solver may complain about the pile-up; that is the subject of another test.
  return make_ode_stepper(settings, [](const std::string&) {});
}

void add(WorldStepper& stepper, int world, const Model& model) {
  stepper.add(world, std::make_shared<Model>(model), model::initial_state(model), 0);
}

void advance(WorldStepper& stepper, int num_steps) {
  core::PhaseTimes times;
  stepper.advance(num_steps, times);
}

std::string kind_name(const testing::TestParamInfo<StepperKind>& kind) {
  return kind.param == StepperKind::quick ? "quick" : "direct";
}

class Determinism : public testing::TestWithParam<StepperKind> {
 protected:
  StepperSettings settings_ = default_settings(GetParam());
  static constexpr int num_steps = 150;

  std::uint64_t alone(int world, const Model& model) const {
    const auto stepper = make_stepper(settings_);
    add(*stepper, world, model);
    advance(*stepper, num_steps);
    return model::hash(stepper->state(world));
  }
};

INSTANTIATE_TEST_SUITE_P(BothSteppers, Determinism, testing::Values(StepperKind::quick, StepperKind::direct),
                         kind_name);

TEST_P(Determinism, of_the_crash_model_is_tried_where_things_happen) {
  const auto stepper = make_stepper(settings_);
  add(*stepper, 0, support::crash());
  int most_contacts = 0, fewest_islands = 100;
  for (int frame = 0; frame < 50; ++frame) {
    advance(*stepper, 3);
    most_contacts = std::max(most_contacts, stepper->observables(0).contacts);
    fewest_islands = std::min(fewest_islands, stepper->observables(0).islands);
  }
  EXPECT_GT(most_contacts, 10);
  EXPECT_EQ(fewest_islands, 1);  // the car runs into both ragdolls
  EXPECT_EQ(stepper->observables(0).nonfinite, 0);
}

TEST_P(Determinism, holds_for_worlds_alone_and_interleaved) {
  const auto together = make_stepper(settings_);
  for (int world = 0; world < 3; ++world) add(*together, world, support::crash(world));
  for (int step = 0; step < num_steps; ++step) advance(*together, 1);
  for (int world = 0; world < 3; ++world) {
    EXPECT_EQ(model::hash(together->state(world)), alone(world, support::crash(world)));
  }
}

TEST_P(Determinism, holds_for_any_order_of_adding) {
  const auto stepper = make_stepper(settings_);
  for (const int world : {7, 2, 5}) add(*stepper, world, support::crash(world));
  advance(*stepper, num_steps);
  for (const int world : {2, 5, 7}) {
    EXPECT_EQ(model::hash(stepper->state(world)), alone(world, support::crash(world)));
  }
}

TEST_P(Determinism, holds_for_any_chunks_of_steps) {
  const auto stepper = make_stepper(settings_);
  add(*stepper, 0, support::crash());
  for (int i = 0; i < num_steps / 3; ++i) advance(*stepper, 3);
  EXPECT_EQ(model::hash(stepper->state(0)), alone(0, support::crash()));
}

/// Steps world 0 through num_steps, and at each of `stops` moves it to a new stepper that knows only its
/// state.
std::uint64_t with_restarts(const StepperSettings& settings, const Model& model,
                            const std::vector<int>& stops, int num_steps) {
  auto stepper = make_stepper(settings);
  add(*stepper, 0, model);
  int step = 0;
  for (const int stop : stops) {
    advance(*stepper, stop - step);
    step = stop;
    const State state = stepper->state(0);
    stepper = make_stepper(settings);
    add(*stepper, 1000 + stop, support::pile(5));  // other company, so that this is not a mere repetition
    stepper->add(0, std::make_shared<Model>(model), state, stop);
  }
  advance(*stepper, num_steps - step);
  return model::hash(stepper->state(0));
}

TEST_P(Determinism, holds_across_a_restart_at_any_step) {
  const Model model = support::crash();
  const std::uint64_t uninterrupted = alone(0, model);
  for (const int stop : {1, 12, 30, 75}) {
    EXPECT_EQ(with_restarts(settings_, model, {stop}, num_steps), uninterrupted) << "at step " << stop;
  }
  EXPECT_EQ(with_restarts(settings_, model, {3, 6, 9, 12, 15, 18, 21, 100}, num_steps), uninterrupted);
}

TEST_P(Determinism, holds_across_a_restart_of_a_pile) {
  const Model model = support::pile(12);
  EXPECT_EQ(with_restarts(settings_, model, {20, 60, 61}, num_steps), alone(0, model));
}

TEST_P(Determinism, holds_across_a_restart_among_events) {
  const Model model = support::crash_with_events();
  const std::uint64_t uninterrupted = alone(0, model);
  EXPECT_NE(uninterrupted, alone(0, support::crash()));
  for (const int stop : {4, 5, 6, 39, 40, 41, 100}) {
    EXPECT_EQ(with_restarts(settings_, model, {stop}, num_steps), uninterrupted) << "at step " << stop;
  }
}

TEST_P(Determinism, holds_for_what_is_left_after_a_removal) {
  const auto stepper = make_stepper(settings_);
  for (int world = 0; world < 3; ++world) add(*stepper, world, support::crash(world));
  advance(*stepper, 20);
  stepper->remove(0);
  advance(*stepper, num_steps - 20);
  for (int world = 1; world < 3; ++world) {
    EXPECT_EQ(model::hash(stepper->state(world)), alone(world, support::crash(world)));
  }
}

TEST_P(Determinism, holds_for_two_steppers_in_one_process) {
  const auto first = make_stepper(settings_);
  const auto second = make_stepper(settings_);
  add(*first, 1, support::crash(1));
  add(*second, 2, support::crash(2));
  for (int i = 0; i < num_steps / 5; ++i) {
    advance(*first, 5);
    advance(*second, 5);
  }
  EXPECT_EQ(model::hash(first->state(1)), alone(1, support::crash(1)));
  EXPECT_EQ(model::hash(second->state(2)), alone(2, support::crash(2)));
}

TEST(QuickStepsShuffle, depends_on_seed_world_and_step) {
  const Model model = support::crash();
  StepperSettings settings = default_settings(StepperKind::quick);
  const std::uint64_t one = hash_after(model, settings, 0, 60);
  EXPECT_NE(hash_after(model, settings, 1, 60), one);
  settings.seed = 2;
  EXPECT_NE(hash_after(model, settings, 0, 60), one);
}

}  // namespace
}  // namespace pbmpi::ode
