// The effect "sleeping" in a world cut into spaces.
#include <gtest/gtest.h>

#include <algorithm>

#include "ode/collide/narrow_phase.h"
#include "solver/worlds/sor_stepper.h"
#include "space_run.h"
#include "stepping/stepper_traits.h"
#include "support/models.h"

namespace pbmpi::mpi {
namespace {

using testing_support::add_to_space;
using testing_support::expect_whole_in_placements;
using testing_support::Oracle;
using testing_support::run_spaces;
using testing_support::share;
using testing_support::SharedModel;
using testing_support::space_settings;
using testing_support::whole_hash;
using testing_support::world;

void add_launch(model::Model& model, int step, int body, const model::Vec3& velocity) {
  model::Event event;
  event.step = step;
  event.body = body;
  event.velocity = velocity;
  model.events.push_back(event);
}

constexpr int num_frames = 70;  // of 3 steps, of 0.01 s

/// Two stacks, with the boxes of each alternating between two spaces, so that islands sleep across ranks; two
/// balls in a third and a fourth space. One is thrown at the first stack after a second, the other at the
/// second after 1.4 s, while the first settles.
model::Model stacks_across_spaces() {
  model::Model model;
  support::add_ground(model);
  model.spaces = {"low", "high", "ball", "other ball"};
  for (const int stack : {0, 1}) {
    const int actor =
        support::add_actor(model, "stack" + std::to_string(stack), model::ActorKind::wall, true);
    for (int i = 0; i < 4; ++i) {
      add_to_space(model,
                   support::add_solid(model, actor, "box" + std::to_string(4 * stack + i), model::Shape::box,
                                      {0.5, 0.5, 0.5}, 2, {8.0 * stack, 0, 0.25 + 0.5 * i}),
                   i % 2);
    }
  }
  for (const int ball : {0, 1}) {
    const std::string name = "ball" + std::to_string(ball);
    const int actor = support::add_actor(model, name, model::ActorKind::projectile);
    const int body = add_to_space(
        model,
        support::add_solid(model, actor, name, model::Shape::sphere, {0.2, 0, 0}, 5, {4, 2.0 * ball, 0.2}),
        2 + ball);
    const model::Vec3 to_stack(8.0 * ball - 4, -2.0 * ball, 1.5);
    add_launch(model, ball == 0 ? 100 : 140, body, 3 * to_stack);
  }
  model.effects["sleeping"] = true;
  return model;
}

SharedModel shared_stacks() { return share(stacks_across_spaces()); }

TEST(SpaceSleep, has_the_bits_of_the_whole_world_for_every_ownership) {
  expect_whole_in_placements(shared_stacks(), num_frames, 37);
}

TEST(SpaceSleep, has_the_bits_of_the_whole_world_while_spaces_change_their_owner) {
  const SharedModel model = shared_stacks();
  WorldRunSettings settings = space_settings(num_frames);
  settings.rebalance_threshold = 1;
  EXPECT_EQ(run_spaces(world(), model, settings, testing_support::ode_steps, Oracle::none).result.state_hash,
            whole_hash(model, settings));
}

TEST(SpaceSleep, sends_nothing_in_the_steps_in_which_all_sleep) {
  model::Model model = stacks_across_spaces();
  model.events.clear();
  WorldRunSettings settings = space_settings(40);
  settings.rebalance_threshold = model::infinity;
  settings.placement = {0, world().size() - 1, 0, 0};
  const auto shared = std::make_shared<const model::Model>(model);
  const auto sleeping = run_spaces(world(), shared, settings, testing_support::ode_steps, Oracle::none);
  if (world().size() == 1) return;
  // All bodies sleep after some 65 of 126 steps; then each rank except root sends one message per frame, its
  // account.
  const auto& frames = sleeping.result.times;
  for (std::size_t frame = 22; frame < frames.size(); ++frame)
    EXPECT_LE(frames[frame].traffic.messages, 1) << "frame " << frame;
  std::int64_t awake = 0;
  for (std::size_t frame = 0; frame < 15; ++frame) awake += frames[frame].traffic.messages;
  EXPECT_GT(awake, 15) << "before that islands go across";
}

/// Makes sure that the scene tests what it should: in some steps all bodies sleep, in some the first stack is
/// awake, and in some the second.
TEST(SpaceSleep, is_tried_where_islands_sleep_and_wake) {
  const SharedModel model = shared_stacks();
  const auto worlds = solver::make_sor_stepper(
      default_settings(stepping::StepperKind::sor, stepping::Law::ode), ode::make_narrow_phase);
  worlds->add(0, model, model::initial_state(*model), 0);
  core::PhaseTimes times;
  const auto asleep = [&](int first, int last) {
    const auto& rest = worlds->state(0).rest;
    return std::all_of(rest.begin() + first, rest.begin() + last,
                       [](const model::Rest& one) { return one.asleep(); });
  };
  bool all = false, first_awake = false, second_awake = false;
  for (int step = 0; step < 3 * (num_frames + 2); ++step) {
    worlds->advance(1, times);
    all |= asleep(0, 10);
    first_awake |= all && !asleep(0, 4) && asleep(4, 8);
    second_awake |= all && !asleep(4, 8);
  }
  EXPECT_TRUE(all);
  EXPECT_TRUE(first_awake);
  EXPECT_TRUE(second_awake);
}

}  // namespace
}  // namespace pbmpi::mpi
