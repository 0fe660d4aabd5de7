/// A step whose state is read before it has ended.
#include <gtest/gtest.h>

#include <string>

#include "ode/collide/narrow_phase.h"
#include "solver/sor_run.h"
#include "solver/worlds/sor_stepper.h"
#include "stepping/names.h"
#include "stepping/stepper_traits.h"
#include "support/models.h"

namespace pbmpi::solver {
namespace {

constexpr int num_worlds = 5;  // some lanes idle, whatever the width

stepping::StepperSettings settings_of(stepping::Simd simd, stepping::Precision precision) {
  stepping::StepperSettings settings = default_settings(stepping::StepperKind::sor, stepping::Law::ode);
  settings.simd = simd;
  settings.precision = precision;
  return settings;
}

/// Has damping, which is applied after a step.
std::shared_ptr<const model::Model> crash(int variant) {
  model::Model model = support::crash(variant);
  model.linear_damping = 0.3;
  model.angular_damping = 0.5;
  return std::make_shared<const model::Model>(std::move(model));
}

/// Crashes of five variants, a few steps after the impact began.
struct Crashes {
  std::vector<model::State> states;
  static constexpr std::int64_t step = 14;

  explicit Crashes(const stepping::StepperSettings& settings) {
    const auto path = make_sor_stepper(settings, ode::make_narrow_phase);
    for (int world = 0; world < num_worlds; ++world)
      path->add(world, crash(world), model::initial_state(*crash(world)), 0);
    advance(*path, step);
    for (int world = 0; world < num_worlds; ++world) states.push_back(path->state(world));
  }
  std::unique_ptr<stepping::AnytimeStepper> start(const stepping::StepperSettings& settings) const {
    auto stepper = make_sor_stepper(settings, ode::make_narrow_phase);
    for (int world = 0; world < num_worlds; ++world)
      stepper->add(world, crash(world), states[static_cast<std::size_t>(world)], step);
    return stepper;
  }
};

std::vector<std::uint64_t> hashes(const stepping::WorldStepper& stepper) {
  std::vector<std::uint64_t> all;
  for (int world = 0; world < num_worlds; ++world) all.push_back(model::hash(stepper.state(world)));
  return all;
}

/// Hashes as looks see the states: the memory that a step hands on is known only when the step has ended.
std::vector<std::uint64_t> hashes_without_memory(const stepping::WorldStepper& stepper) {
  std::vector<std::uint64_t> all;
  for (int world = 0; world < num_worlds; ++world) {
    model::State state = stepper.state(world);
    state.memory.clear();
    all.push_back(model::hash(state));
  }
  return all;
}

std::vector<std::uint64_t> looks(const stepping::AnytimeStepper& stepper) {
  std::vector<std::uint64_t> all;
  for (int world = 0; world < num_worlds; ++world) all.push_back(model::hash(stepper.look(world)));
  return all;
}

class Anytime : public testing::TestWithParam<std::tuple<stepping::Simd, stepping::Precision>> {
 protected:
  stepping::StepperSettings settings() const {
    return settings_of(std::get<0>(GetParam()), std::get<1>(GetParam()));
  }
};

TEST_P(Anytime, a_look_is_the_state_of_a_run_of_so_many_iterations) {
  const Crashes crashes(settings());
  core::PhaseTimes times;
  for (const int iterations : {1, 2, 9, 20}) {
    const auto stepper = crashes.start(settings());
    stepper->begin_step(iterations, times);
    stepping::StepperSettings few = settings();
    few.iterations = iterations;
    const auto short_run = crashes.start(few);
    advance(*short_run, 1);
    EXPECT_EQ(looks(*stepper), hashes_without_memory(*short_run)) << iterations << " iterations";
  }
}

TEST_P(Anytime, a_look_changes_no_bit_of_the_step) {
  const Crashes crashes(settings());
  core::PhaseTimes times;
  const auto alone = crashes.start(settings());
  advance(*alone, 3);
  for (const int iterations : {0, 1, 8, 20}) {
    const auto looked_at = crashes.start(settings());
    for (int step = 0; step < 3; ++step) {
      looked_at->begin_step(iterations, times);
      advance(*looked_at, 1);
    }
    EXPECT_EQ(hashes(*looked_at), hashes(*alone)) << iterations << " iterations";
  }
}

TEST_P(Anytime, of_several_steps_and_substeps_the_first_step_was_begun) {
  stepping::StepperSettings substeps = settings();
  substeps.substeps = 3;
  substeps.iterations = 4;
  substeps.law.warm_start = 0.5;
  const Crashes crashes(substeps);
  core::PhaseTimes times;
  const auto alone = crashes.start(substeps), one = crashes.start(substeps), begun = crashes.start(substeps);
  advance(*alone, 3);
  advance(*one, 1);
  begun->begin_step(4, times);
  EXPECT_EQ(looks(*begun), hashes_without_memory(*one)) << "after all iterations of the last substep";
  advance(*begun, 3);
  EXPECT_EQ(hashes(*begun), hashes(*alone));
}

std::vector<stepping::Simd> simds() { return machine_simds(); }
INSTANTIATE_TEST_SUITE_P(every_width, Anytime,
                         testing::Combine(testing::ValuesIn(simds()),
                                          testing::Values(stepping::Precision::double_,
                                                          stepping::Precision::single)),
                         [](const auto& test) {
                           return std::string(name_of(std::get<0>(test.param))) + "_" +
                                  std::string(name_of(std::get<1>(test.param)));
                         });

TEST(AnytimeStepper, what_was_begun_is_dropped_when_worlds_come_go_or_change) {
  const stepping::StepperSettings settings =
      settings_of(stepping::Simd::automatic, stepping::Precision::double_);
  const Crashes crashes(settings);
  core::PhaseTimes times;
  const auto expected = crashes.start(settings);
  advance(*expected, 1);
  const auto stepper = crashes.start(settings);
  stepper->begin_step(5, times);
  stepper->set_state(1, crashes.states[1], Crashes::step);
  stepper->begin_step(5, times);
  stepper->remove(2);
  stepper->begin_step(5, times);
  stepper->add(2, crash(2), crashes.states[2], Crashes::step);
  advance(*stepper, 1);
  EXPECT_EQ(hashes(*stepper), hashes(*expected));
}

TEST(AnytimeStepper, a_look_remembers_nothing) {
  const stepping::StepperSettings settings =
      settings_of(stepping::Simd::automatic, stepping::Precision::double_);
  Crashes crashes(settings);
  crashes.states[0].memory.contacts.push_back({{0, 1}, 0, model::no_body, {0, 0, 1}, 5});
  core::PhaseTimes times;
  const auto stepper = crashes.start(settings);
  stepper->begin_step(20, times);
  EXPECT_TRUE(stepper->look(0).memory.empty());
}

TEST(AnytimeStepper, a_step_cannot_be_begun_twice_or_beyond_its_iterations) {
  const stepping::StepperSettings settings =
      settings_of(stepping::Simd::automatic, stepping::Precision::double_);
  core::PhaseTimes times;
  const auto stepper = Crashes(settings).start(settings);
  EXPECT_ANY_THROW(stepper->begin_step(21, times));
  stepper->begin_step(20, times);
  EXPECT_ANY_THROW(stepper->begin_step(1, times));
}

}  // namespace
}  // namespace pbmpi::solver
