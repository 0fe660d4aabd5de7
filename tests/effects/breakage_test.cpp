#include "effects/breakage.h"

#include <gtest/gtest.h>

#include "effects/effect_choices.h"
#include "effects/effects.h"
#include "effects/sleepers.h"
#include "model/joint_gap.h"
#include "model/touch_rule.h"
#include "support/models.h"

namespace pbmpi::effects {
namespace {

/// A chain of three links that hangs on the world; the second and the third joint can break.
model::Model weak_chain() {
  model::Model model = support::chain(3);
  model.actors[0].self_collision = true;
  model.joints[1].break_force = 100;
  model.joints[2].break_torque = 20;
  return model;
}

model::State whole(const model::Model& model) {
  model::State state = model::initial_state(model);
  Breakage(model).start(state);
  return state;
}

TEST(Breakage, breaks_above_the_strength_and_not_at_it) {
  const model::Model model = weak_chain();
  EXPECT_FALSE(breaks(model.joints[1], {100, 1e9}));
  EXPECT_TRUE(breaks(model.joints[1], {100.001, 0}));
  EXPECT_FALSE(breaks(model.joints[2], {1e9, 20}));
  EXPECT_TRUE(breaks(model.joints[2], {0, 20.001}));
  EXPECT_FALSE(breaks(model.joints[0], {1e9, 1e9})) << "it has no strength, so that it never breaks";
}

TEST(Breakage, asks_for_the_joints_that_can_break_and_hold) {
  const model::Model model = weak_chain();
  const Breakage breakage(model);
  model::State state = whole(model);
  std::vector<int> asked;
  const auto light = [&](int joint) {
    asked.push_back(joint);
    return Reaction{};
  };
  EXPECT_FALSE(breakage.break_overloaded_joints(3, breakage.joints(), light, state));
  EXPECT_EQ(asked, (std::vector<int>{1, 2}));
  const auto heavy = [&](int joint) { return Reaction{joint == 1 ? 101.0 : 0.0, 0}; };
  EXPECT_TRUE(breakage.break_overloaded_joints(4, breakage.joints(), heavy, state));
  EXPECT_EQ(state.broken_in, (std::vector<std::int32_t>{model::unbroken, 4, model::unbroken}));
  asked.clear();
  EXPECT_FALSE(breakage.break_overloaded_joints(5, breakage.joints(), light, state));
  EXPECT_EQ(asked, std::vector<int>{2});
  EXPECT_TRUE(state.acted_in(4, 1));
  EXPECT_FALSE(state.acted_in(5, 1));
}

TEST(Breakage, breaks_a_released_joint_at_the_end_of_the_step_before) {
  model::Model model = weak_chain();
  model::Event release;
  release.kind = model::EventKind::release;
  release.step = 5;
  release.joint = 0;
  model.events.push_back(release);
  const Breakage breakage(model);
  EXPECT_EQ(breakage.joints().size(), 3u);
  model::State state = whole(model);
  const auto light = [](int joint) {
    EXPECT_NE(joint, 0) << "it has no strength";
    return Reaction{};
  };
  EXPECT_FALSE(breakage.break_overloaded_joints(3, breakage.joints(), light, state));
  EXPECT_TRUE(breakage.break_overloaded_joints(4, breakage.joints(), light, state));
  EXPECT_EQ(state.broken_in, (std::vector<std::int32_t>{4, model::unbroken, model::unbroken}));
}

TEST(Breakage, is_called_for_by_releases) {
  model::Model model = support::chain(3);
  model::Event release;
  release.kind = model::EventKind::release;
  release.step = 5;
  release.joint = 1;
  model.events.push_back(release);
  EXPECT_TRUE(StepPlan(model).has(EffectId::breakable_joints));
  model.effects["breakable_joints"] = false;
  leave_out_effects(model);
  EXPECT_TRUE(model.events.empty());
}

TEST(Breakage, leaves_joints_of_bodies_that_sleep_alone) {
  const model::Model model = weak_chain();
  const Breakage breakage(model);
  model::State state = whole(model);
  state.rest.resize(3);
  state.rest[1].sleep_in(0);
  const auto heavy = [](int) { return Reaction{1e6, 1e6}; };
  EXPECT_TRUE(breakage.break_overloaded_joints(7, breakage.joints(), heavy, state));
  EXPECT_FALSE(state.is_broken(1)) << "its first body, link 1, sleeps";
  EXPECT_TRUE(state.is_broken(2));
}

TEST(Breakage, is_part_of_the_hash_once_something_has_broken) {
  const model::Model model = weak_chain();
  model::State state = whole(model);
  const std::uint64_t before = model::hash(state);
  EXPECT_EQ(before, model::hash(model::initial_state(model)))
      << "a pass in which nothing breaks changes no bit";
  state.broken_in[1] = 4;
  const std::uint64_t broken = model::hash(state);
  EXPECT_NE(broken, before);
  state.broken_in[1] = 5;
  EXPECT_NE(model::hash(state), broken);
}

TEST(Breakage, lets_the_bodies_touch_unless_another_joint_holds_them) {
  model::Model model = weak_chain();
  std::vector<std::int32_t> broken_in = {model::unbroken, 2, model::unbroken};
  EXPECT_FALSE(model::TouchRule(model).may_touch(0, 1));
  EXPECT_TRUE(model::TouchRule(model, broken_in).may_touch(0, 1));
  EXPECT_FALSE(model::TouchRule(model, broken_in).may_touch(1, 2));
  support::add_joint(model, model::JointKind::ball, 1, 0, {0.5, 0, 5});
  broken_in.push_back(model::unbroken);
  EXPECT_FALSE(model::TouchRule(model, broken_in).may_touch(0, 1));
  model.actors[0].self_collision = false;
  broken_in[3] = 2;
  EXPECT_FALSE(model::TouchRule(model, broken_in).may_touch(0, 1)) << "what the actor says stands";
}

TEST(Breakage, parts_what_falls_asleep) {
  const model::Model model = weak_chain();
  model::State state = whole(model);
  Sleepers sleepers(model, 0.01);
  sleepers.start(state);
  state.broken_in[2] = 0;
  for (int step = 0; step < 60; ++step) {
    state.position[2].x() += 0.01;  // link 2 moves at 1 m/s
    sleepers.count(sleepers.awake(), state);
    sleepers.put_to_sleep(sleepers.find_resting(
                              sleepers.awake(), {}, [](int) { return false; }, state),
                          state);
  }
  EXPECT_TRUE(state.rest[0].asleep() && state.rest[1].asleep());
  EXPECT_FALSE(state.rest[2].asleep());
}

TEST(Breakage, takes_the_gap_of_joints_that_hold_only) {
  const model::Model model = weak_chain();
  model::State state = whole(model);
  state.position[2].z() += 3;
  EXPECT_NEAR(model::max_joint_gap(model, state), 3, 1e-12);  // rounding at 5 m
  state.broken_in[2] = 9;
  EXPECT_NEAR(model::max_joint_gap(model, state), 0, 1e-12);
}

TEST(Breakage, is_called_for_by_strengths_and_can_be_left_out) {
  model::Model model = weak_chain();
  const StepPlan plan(model);
  const auto pass = std::find_if(plan.passes().begin(), plan.passes().end(), [](const Pass& one) {
    return one.effect->id == EffectId::breakable_joints;
  });
  ASSERT_NE(pass, plan.passes().end());
  EXPECT_EQ(pass->reason.text(), "2 joints with a strength");
  model.effects["breakable_joints"] = false;
  leave_out_effects(model);
  EXPECT_FALSE(model.joints[1].breakable() || model.joints[2].breakable());
  EXPECT_FALSE(StepPlan(support::chain(3)).has(EffectId::breakable_joints));
}

}  // namespace
}  // namespace pbmpi::effects
