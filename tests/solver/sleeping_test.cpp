// The effect "sleeping" in all steppers: quick, direct and sor.
#include <gtest/gtest.h>

#include <algorithm>
#include <ostream>

#include "effects/sleepers.h"
#include "ode/ode_stepper.h"
#include "solver/sor_run.h"
#include "stepping/step_options.h"
#include "support/models.h"

namespace pbmpi::solver {
namespace {

using model::Model;
using model::State;
using stepping::StepperKind;
using stepping::StepperSettings;

constexpr int launch_step = 130;

/// Two stacks of boxes, 20 m apart, and a ball between them that lies on the ground until it is thrown at the
/// first one.
Model stacks(int height = 4, int launched_at = launch_step) {
  Model model;
  support::add_ground(model);
  for (const int stack : {0, 1}) {
    const int actor =
        support::add_actor(model, "stack" + std::to_string(stack), model::ActorKind::wall, true);
    for (int i = 0; i < height; ++i) {
      support::add_solid(model, actor, "box" + std::to_string(height * stack + i), model::Shape::box,
                         {0.5, 0.5, 0.5}, 2, {20.0 * stack, 0, 0.25 + 0.5 * i});
    }
  }
  const int actor = support::add_actor(model, "ball", model::ActorKind::projectile);
  const int ball =
      support::add_solid(model, actor, "ball", model::Shape::sphere, {0.2, 0, 0}, 5, {3, 0, 0.2});
  model::Event event;
  event.step = launched_at;
  event.body = ball;
  event.velocity = {-12, 0, 2};
  model.events.push_back(event);
  model.effects["sleeping"] = true;
  return model;
}

std::unique_ptr<stepping::WorldStepper> make(const StepperSettings& settings) {
  if (settings.kind == StepperKind::sor) return make_stepper(settings);
  return ode::make_ode_stepper(settings, [](const std::string&) {});
}

std::unique_ptr<stepping::WorldStepper> start(const StepperSettings& settings, const Model& model,
                                              const State& state, std::int64_t step = 0) {
  auto stepper = make(settings);
  stepper->add(0, std::make_shared<const Model>(model), state, step);
  return stepper;
}

int num_asleep(const State& state) {
  return static_cast<int>(std::count_if(state.rest.begin(), state.rest.end(),
                                        [](const model::Rest& rest) { return rest.asleep(); }));
}

struct Case {
  const char* name;
  StepperKind kind;
  stepping::Precision precision;
  int height;  ///< of a stack; ODE's dWorldStep makes boxes on boxes creep
  bool remembers = false;
};

void PrintTo(const Case& one, std::ostream* out) { *out << one.name; }

class Sleeping : public testing::TestWithParam<Case> {
 protected:
  StepperSettings settings() const {
    const stepping::Law law = GetParam().remembers ? stepping::Law::soft : stepping::Law::ode;
    StepperSettings settings = default_settings(GetParam().kind, law);
    settings.precision = GetParam().precision;
    return settings;
  }
  int height() const { return GetParam().height; }
  int num_bodies() const { return 2 * height() + 1; }
};

INSTANTIATE_TEST_SUITE_P(
    Steppers, Sleeping,
    testing::Values(Case{"quick", StepperKind::quick, stepping::Precision::double_, 4},
                    Case{"direct", StepperKind::direct, stepping::Precision::double_, 1},
                    Case{"sor", StepperKind::sor, stepping::Precision::double_, 4},
                    Case{"remembering", StepperKind::sor, stepping::Precision::double_, 4, true},
                    Case{"remembering_single", StepperKind::sor, stepping::Precision::single, 4, true},
                    Case{"sor_single", StepperKind::sor, stepping::Precision::single, 4}),
    [](const auto& instance) { return instance.param.name; });

TEST_P(Sleeping, world_keeps_its_bits_and_solves_nothing) {
  const Model model = stacks(height());
  const auto stepper = start(settings(), model, model::initial_state(model));
  advance(*stepper, 30);
  EXPECT_EQ(num_asleep(stepper->state(0)), 0) << "half a second has not passed";
  const stepping::Observables awake = stepper->observables(0);
  EXPECT_GT(awake.rows, 0);
  advance(*stepper, 90);
  ASSERT_EQ(num_asleep(stepper->state(0)), num_bodies());
  const std::uint64_t settled = model::hash(stepper->state(0));
  const double energy_j = stepper->observables(0).energy_j;
  for (int i = 0; i < 3; ++i) {
    advance(*stepper, 3);
    EXPECT_EQ(model::hash(stepper->state(0)), settled);
    EXPECT_EQ(stepper->observables(0).rows, 0);
    EXPECT_EQ(stepper->observables(0).contacts, 0);
    EXPECT_EQ(stepper->observables(0).islands, awake.islands) << "islands that sleep are islands";
    EXPECT_EQ(stepper->observables(0).energy_j, energy_j);
  }
  for (const model::Vec3& velocity : stepper->state(0).velocity) EXPECT_EQ(velocity, model::Vec3(0, 0, 0));
}

/// Largest difference of the velocities [m/s] of the bodies that are awake in `look`.
double largest_difference(const State& a, const State& b, const State& look) {
  double largest = 0;
  for (std::size_t body = 0; body < look.rest.size(); ++body) {
    if (!look.rest[body].asleep()) largest = std::max(largest, (a.velocity[body] - b.velocity[body]).norm());
  }
  return largest;
}

/// Steps one by one until fewer bodies sleep; returns the state before that step.
State until_touched(stepping::WorldStepper& stepper, int most_asleep, std::int64_t& step) {
  for (;; ++step) {
    const State before = stepper.state(0);
    advance(stepper, 1);
    if (step > launch_step && num_asleep(stepper.state(0)) < most_asleep) return before;
    if (step > launch_step + 100) throw std::runtime_error("the ball has touched nothing");
  }
}

TEST_P(Sleeping, stack_wakes_in_the_step_in_which_a_projectile_touches_it) {
  const Model model = stacks(height());
  const auto stepper = start(settings(), model, model::initial_state(model));
  advance(*stepper, launch_step);
  ASSERT_EQ(num_asleep(stepper->state(0)), num_bodies());
  std::int64_t step = launch_step;
  const State before = until_touched(*stepper, 2 * height(), step);
  const State& after = stepper->state(0);
  EXPECT_EQ(num_asleep(after), height()) << "the far stack sleeps on, the near one is awake as a whole";
  for (int body = 0; body < height(); ++body) EXPECT_NE(after.velocity[body], model::Vec3(0, 0, 0)) << body;
  for (int body = height(); body < 2 * height(); ++body)
    EXPECT_EQ(after.position[body], before.position[body]) << body;

  // The same step in a world without sleeping. sor solves an island on its own, so the bits are the same.
  // QuickStep shuffles the rows of all islands with one sequence of random numbers: the change due to another
  // seed is the allowed difference (four seeds sample it; three times their largest leaves room for the
  // tail). direct factors one matrix per island, which for a cube and a ball only rounds.
  Model restless = model;
  restless.effects.clear();
  State same = before;
  same.rest.clear();
  const auto kept_awake = [&](std::uint64_t seed) {
    StepperSettings seeded = settings();
    seeded.seed = seed;
    const auto other = start(seeded, restless, same, step);
    advance(*other, 1);
    return other->state(0);
  };
  const State expected = kept_awake(settings().seed);
  double tolerance = settings().kind == StepperKind::direct ? 1e-9 : 0;
  for (const std::uint64_t seed : {2, 3, 4, 5}) {
    if (settings().kind == StepperKind::quick)
      tolerance = std::max(tolerance, 3 * largest_difference(kept_awake(seed), expected, after));
  }
  EXPECT_LE(largest_difference(after, expected, after), tolerance);
}

TEST_P(Sleeping, world_has_the_same_bits_across_a_restart_at_any_step) {
  const Model model = stacks(height());
  constexpr int num_steps = launch_step + 60;
  const auto whole = start(settings(), model, model::initial_state(model));
  advance(*whole, num_steps);
  for (const int stop : {20, 49, 51, 110, launch_step, launch_step + 1, launch_step + 25, launch_step + 40}) {
    const auto first = start(settings(), model, model::initial_state(model));
    advance(*first, stop);
    const auto second = start(settings(), model, first->state(0), stop);
    advance(*second, num_steps - stop);
    EXPECT_EQ(model::hash(second->state(0)), model::hash(whole->state(0))) << "at step " << stop;
    EXPECT_EQ(num_asleep(second->state(0)), num_asleep(whole->state(0))) << "at step " << stop;
  }
}

TEST_P(Sleeping, world_goes_on_from_a_state_that_it_is_put_into) {
  const Model model = stacks(height());
  const auto whole = start(settings(), model, model::initial_state(model));
  advance(*whole, launch_step);
  const State asleep = whole->state(0);
  advance(*whole, 40);
  const std::uint64_t expected = model::hash(whole->state(0));
  whole->set_state(0, asleep, launch_step);
  EXPECT_EQ(num_asleep(whole->state(0)), num_bodies());
  advance(*whole, 40);
  EXPECT_EQ(model::hash(whole->state(0)), expected);
}

TEST_P(Sleeping, joint_is_woken_by_its_motor) {
  Model model = support::pendulum(1, 0);
  model.effects["sleeping"] = true;
  model::Event event;
  event.step = 100;
  event.kind = model::EventKind::motor;
  event.joint = 0;
  event.motor = {2, 1000};
  model.events.push_back(event);
  const auto stepper = start(settings(), model, model::initial_state(model));
  advance(*stepper, 100);
  EXPECT_EQ(num_asleep(stepper->state(0)), 1) << "it hangs straight down";
  advance(*stepper, 1);
  EXPECT_GT(stepper->state(0).angular_velocity[0].norm(), 1) << "driven at 2 rad/s";
}

// Worlds whose balls fly at different times share batches of lanes: those that sleep must not move along.
TEST(SleepingInPacks, worlds_have_the_bits_that_each_has_alone_for_every_instruction_set) {
  std::vector<Model> worlds;
  for (const int launched_at : {70, 90, 110, 75, 400, 95, 85}) worlds.push_back(stacks(4, launched_at));
  constexpr int num_steps = 150;
  for (const stepping::Precision precision : {stepping::Precision::double_, stepping::Precision::single}) {
    StepperSettings settings = default_settings(StepperKind::sor);
    settings.precision = precision;
    std::vector<std::uint64_t> alone;
    for (const Model& model : worlds) {
      const auto stepper = start(settings, model, model::initial_state(model));
      advance(*stepper, num_steps);
      alone.push_back(model::hash(stepper->state(0)));
    }
    for (const stepping::Simd simd : machine_simds()) {
      settings.simd = simd;
      const auto together = make_stepper(settings, worlds);
      advance(*together, num_steps);
      for (std::size_t i = 0; i < worlds.size(); ++i)
        EXPECT_EQ(model::hash(together->state(static_cast<int>(i))), alone[i]) << i;
      EXPECT_EQ(num_asleep(together->state(4)), 9) << "its ball has not flown";
      EXPECT_LT(num_asleep(together->state(2)), 8);
    }
  }
}

}  // namespace
}  // namespace pbmpi::solver
