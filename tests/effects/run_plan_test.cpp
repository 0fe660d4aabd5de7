#include "effects/run_plan.h"

#include <gtest/gtest.h>

#include "support/models.h"

namespace pbmpi::effects {
namespace {

/// "effect: reason", one line per pass.
std::string text_of(const RunPlan& plan) {
  std::string text;
  for (const RunPass& pass : plan.passes())
    text += std::string(pass.effect->name) + ": " + pass.reason + "\n";
  return text;
}

RunPlan plan_of(const std::vector<model::Model>& worlds) {
  RunPlan plan;
  for (const model::Model& world : worlds) plan.add(world);
  return plan;
}

TEST(RunPlan, of_one_world_says_what_its_step_plan_says) {
  const model::Model model = support::crash();
  const StepPlan step(model);
  const auto passes = plan_of({model}).passes();
  ASSERT_EQ(passes.size(), step.passes().size());
  for (std::size_t i = 0; i < passes.size(); ++i) {
    EXPECT_EQ(passes[i].effect, step.passes()[i].effect);
    EXPECT_EQ(passes[i].reason, step.passes()[i].reason.text());
  }
}

TEST(RunPlan, counts_what_is_in_all_worlds) {
  const model::Model box = support::box_over_ground(1);
  EXPECT_EQ(
      text_of(plan_of({box, box, box})),
      "collision: 6 geoms, in 3 worlds\n"
      "fast_bodies: 3 moving geoms, armed in steps in which one moves by more than half its extent, in 3 "
      "worlds\n"
      "friction: 6 geoms with mu > 0, in 3 worlds\n"
      "gravity: 3 bodies under 9.81 m/s^2, in 3 worlds\n");
}

TEST(RunPlan, says_how_many_worlds_call_for_a_pass_where_they_differ) {
  EXPECT_EQ(
      text_of(plan_of({support::box_over_ground(1), support::pile(3), support::pendulum(1, 0)})),
      "collision: 6 geoms, in 2 of 3 worlds\n"
      "fast_bodies: 4 moving geoms, armed in steps in which one moves by more than half its extent, in 2 of "
      "3 worlds\n"
      "friction: 6 geoms with mu > 0, in 2 of 3 worlds\n"
      "joints: 1 joints, in 1 of 3 worlds\n"
      "gravity: 5 bodies under 9.81 m/s^2, in 3 worlds\n");
}

TEST(RunPlan, keeps_apart_what_is_not_the_same) {
  model::Model light = support::box_over_ground(1);
  light.gravity = {0, 0, -1.62};
  light.effects["friction"] = light.effects["collision"] = false;
  model::Model heavy = support::box_over_ground(1);
  heavy.effects = light.effects;
  EXPECT_EQ(text_of(plan_of({heavy, light, light})),
            "gravity: 2 bodies under 1.62 m/s^2, 1 bodies under 9.81 m/s^2, in 3 worlds\n");
}

TEST(RunPlan, tells_what_is_demanded_from_what_is_called_for) {
  model::Model smooth = support::box_over_ground(1);
  smooth.effects = {{"restitution", true}, {"friction", false}};
  EXPECT_NE(text_of(plan_of({smooth, smooth})).find("restitution: demanded; nothing calls for it\n"),
            std::string::npos);
  model::Model bouncing = smooth;
  bouncing.geoms[0].material.restitution = 0.5;
  EXPECT_NE(
      text_of(plan_of({smooth, bouncing, smooth}))
          .find("restitution: 1 geoms with restitution > 0, in 1 of 3 worlds; demanded in the others\n"),
      std::string::npos);
}

TEST(RunPlan, added_up_in_parts_is_that_of_all_worlds) {
  const std::vector<model::Model> worlds = {support::crash(), support::pile(3), support::pendulum(1, 0)};
  RunPlan parts = plan_of({worlds[1]});
  parts.add(RunPlan());  // plan of a rank without worlds
  parts.add(plan_of({worlds[2], worlds[0]}));
  EXPECT_EQ(text_of(parts), text_of(plan_of(worlds)));
}

}  // namespace
}  // namespace pbmpi::effects
