/// A world that runs on and one that is restored from its state have the same bits.
#include <gtest/gtest.h>

#include "mujoco/mujoco_stepper.h"
#include "simulation.h"
#include "support/models.h"

namespace pbmpi::mujoco {
namespace {

using model::Model;

struct Case {
  const char* name;
  Model (*make)();
};

const Case cases[] = {{"a_free_box", support::free_box},
                      {"a_pendulum", [] { return support::pendulum(1, 0.5); }},
                      {"a_chain", [] { return support::chain(5); }},
                      {"a_pile", [] { return support::pile(4); }},
                      {"balls", [] { return support::falling_balls(3, 0.5); }},
                      {"a_crash", [] { return support::crash(); }}};

class MujocoRestore : public testing::TestWithParam<Case> {};
INSTANTIATE_TEST_SUITE_P(Models, MujocoRestore, testing::ValuesIn(cases),
                         [](const auto& test) { return std::string(test.param.name); });

TEST_P(MujocoRestore, after_10_of_20_steps_changes_no_bit) {
  const Model model = GetParam().make();
  EXPECT_EQ(hash_after(model, 20), hash_after_restore(model, 10, 10));
}

TEST_P(MujocoRestore, after_39_of_40_steps_changes_no_bit) {
  const Model model = GetParam().make();
  EXPECT_EQ(hash_after(model, 40), hash_after_restore(model, 39, 1));
}

TEST_P(MujocoRestore, by_set_state_changes_no_bit) {
  const Model model = GetParam().make();
  Simulation simulation(model);
  simulation.advance(10);
  const model::State middle = simulation.state();
  simulation.advance(30);
  const std::uint64_t hash = model::hash(simulation.state());
  simulation.stepper().set_state(0, middle, 10);
  EXPECT_EQ(model::hash(simulation.state()), model::hash(middle));
  simulation.advance(30);
  EXPECT_EQ(model::hash(simulation.state()), hash);
}

TEST_P(MujocoRestore, does_not_depend_on_other_worlds_or_on_how_steps_are_grouped) {
  const auto model = std::make_shared<const Model>(GetParam().make());
  const auto stepper = make_mujoco_stepper(settings_with());
  core::PhaseTimes times;
  stepper->add(4, model, model::initial_state(*model), 0);
  stepper->advance(7, times);
  stepper->add(2, std::make_shared<Model>(support::crash()), model::initial_state(support::crash()), 0);
  stepper->advance(6, times);
  stepper->remove(2);
  stepper->advance(7, times);
  EXPECT_EQ(model::hash(stepper->state(4)), hash_after(*model, 20));
}

}  // namespace
}  // namespace pbmpi::mujoco
