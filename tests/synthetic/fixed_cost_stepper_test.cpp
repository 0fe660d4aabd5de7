#include "synthetic/fixed_cost_stepper.h"

#include <gtest/gtest.h>

#include "core/clock.h"

namespace pbmpi::synthetic {
namespace {

model::State stepped(int world, std::vector<int> calls) {
  FixedCostStepper stepper(0);
  const auto model = make_model(4);
  stepper.add(world, model, model::initial_state(*model), 0);
  core::PhaseTimes times;
  for (const int steps : calls) stepper.advance(steps, times);
  return stepper.state(world);
}

TEST(FixedCostStepper, has_a_state_that_depends_on_world_and_step_alone) {
  EXPECT_EQ(model::hash(stepped(3, {6})), model::hash(stepped(3, {1, 2, 3})));
  EXPECT_NE(model::hash(stepped(3, {6})), model::hash(stepped(4, {6})));
  EXPECT_NE(model::hash(stepped(3, {6})), model::hash(stepped(3, {5})));
}

TEST(FixedCostStepper, says_that_a_world_costs_what_it_was_told) {
  FixedCostStepper stepper(1e-5);
  const auto model = make_model(1);
  for (const int world : {0, 1}) stepper.add(world, model, model::initial_state(*model), 0);
  core::PhaseTimes times;
  const double start_s = core::now_s();
  stepper.advance(3, times);
  EXPECT_GE(core::now_s() - start_s, 2 * 3e-5)
      << "two worlds, three steps each; it cannot be faster than the clock";
  EXPECT_DOUBLE_EQ(stepper.cost_s(1), 3e-5);
}

}  // namespace
}  // namespace pbmpi::synthetic
