#include "stability/finer_steps.h"

#include <gtest/gtest.h>

#include "guarded_run.h"
#include "support/models.h"

namespace pbmpi::stability {
namespace {

using model::Model;
using model::State;

TEST(FinerSteps, keep_the_times_of_events) {
  Model model = support::free_box();
  model::Event launch;
  launch.step = 7;
  launch.body = 0;
  model.events = {launch};
  EXPECT_EQ(in_finer_steps(model, 4).events[0].step, 28);
}

TEST(FinerSteps, count_rest_and_breaks_in_steps_of_the_run) {
  State state = initial_state(support::pile(3));
  state.rest.resize(3);
  state.rest[0].idle_steps = 5;
  state.rest[0].watches[0].steps = 7;
  state.rest[0].watches[1].steps = 3;
  state.rest[1].sleep_in(2);
  state.broken_in = {model::unbroken, 3, model::unbroken};
  const State before = state;
  State finer = to_finer_steps(state, 8);
  EXPECT_EQ(finer.rest[0].idle_steps, 40);
  EXPECT_EQ(finer.rest[0].watches[0].steps, 56);
  EXPECT_EQ(finer.rest[0].watches[1].steps, 3) << "counted in intervals of the first";
  EXPECT_EQ(finer.rest[1].island(), 2);
  EXPECT_TRUE(finer.is_broken(1));
  finer.rest[0].idle_steps += 8;
  finer.broken_in[2] = 8 * 11 + 5;
  state = from_finer_steps(finer, 8, before);
  EXPECT_EQ(state.rest[0].idle_steps, 6);
  EXPECT_EQ(state.rest[0].watches[0].steps, 7);
  EXPECT_EQ(state.rest[1].island(), 2);
  EXPECT_EQ(state.broken_in, (std::vector<std::int32_t>{model::unbroken, 3, 11}));
}

TEST(FinerSteps, of_a_free_fall_come_nearer_to_it) {
  const Model model = support::free_box();
  GuardSettings settings;
  settings.make_stepper = make_any_stepper;
  const State start = initial_state(model);
  const double exact = 0.5 * 9.81 * 0.01 * 0.01;
  double last_error = model::infinity;
  for (const int finer : {1, 2, 4}) {
    const FinerResult result = step_finer(settings, 0, model, {}, start, 5, finer);
    const double error =
        std::abs(start.position[0].z() - result.state.position[0].z() - exact + 0.01 * start.velocity[0].z());
    EXPECT_LT(error, last_error);
    last_error = error;
    EXPECT_NEAR(result.state.velocity[0].z(), start.velocity[0].z() - 9.81 * 0.01, 1e-12);
  }
}

}  // namespace
}  // namespace pbmpi::stability
