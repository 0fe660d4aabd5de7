#include "effects/effects.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "effects/effect_choices.h"
#include "support/models.h"

namespace pbmpi::effects {
namespace {

std::vector<std::string> pass_names(const model::Model& model) {
  const StepPlan plan(model);
  std::vector<std::string> names;
  for (const Pass& pass : plan.passes()) names.emplace_back(pass.effect->name);
  return names;
}

using Names = std::vector<std::string>;

TEST(StepPlan, of_a_free_smooth_body_has_gravity_only) {
  model::Model model = support::free_box();
  model.geoms[0].material.mu = 0;
  EXPECT_EQ(pass_names(model), (Names{"gyroscopic_torque", "gravity"}));
}

TEST(StepPlan, is_empty_where_nothing_is_called_for) {
  model::Model model = support::free_box();
  model.geoms[0].material.mu = 0;
  model.gravity.setZero();
  model.bodies[0].inertia = 0.3 * core::Mat3::Identity();
  EXPECT_EQ(pass_names(model), Names{});
}

TEST(StepPlan, of_a_box_on_the_ground_collides_with_friction) {
  model::Model model = support::box_over_ground(0);
  EXPECT_EQ(pass_names(model), (Names{"collision", "fast_bodies", "friction", "gravity"}));
  for (model::Geom& geom : model.geoms) geom.material.mu = 0;
  model.geoms[0].material.restitution = 0.5;
  EXPECT_EQ(pass_names(model), (Names{"collision", "fast_bodies", "restitution", "gravity"}));
}

TEST(StepPlan, has_joints_and_each_thing_that_a_joint_asks_for) {
  model::Model model = support::pendulum(1, 0.1);
  EXPECT_TRUE(StepPlan(model).has(EffectId::joints));
  EXPECT_FALSE(StepPlan(model).has(EffectId::limits));
  EXPECT_FALSE(StepPlan(model).has(EffectId::motors));
  EXPECT_FALSE(StepPlan(model).has(EffectId::suspension));
  model.joints[0].limits[1].high = 1;
  model.joints[0].motors[0].max_force = 1;
  model.joints[0].suspension.stiffness = 1;
  EXPECT_TRUE(StepPlan(model).has(EffectId::limits));
  EXPECT_TRUE(StepPlan(model).has(EffectId::motors));
  EXPECT_TRUE(StepPlan(model).has(EffectId::suspension));
}

TEST(StepPlan, has_a_pass_for_each_kind_of_event) {
  for (const auto& [kind, effect] : {std::pair{model::EventKind::launch, EffectId::events},
                                     {model::EventKind::steer, EffectId::steering},
                                     {model::EventKind::motor, EffectId::motors}}) {
    model::Model model = support::pendulum(1, 0.1);
    EXPECT_FALSE(StepPlan(model).has(effect));
    model::Event event;
    event.kind = kind;
    model.events.push_back(event);
    EXPECT_TRUE(StepPlan(model).has(effect));
  }
}

TEST(StepPlan, keeps_the_order_of_the_registry) {
  const StepPlan plan(support::crash());
  std::size_t at = 0;
  for (const Pass& pass : plan.passes()) {
    while (at < effect_registry().size() && effect_registry()[at].name != pass.effect->name) ++at;
    ASSERT_LT(at, effect_registry().size()) << pass.effect->name << " stands too early";
  }
  EXPECT_GE(plan.passes().size(), 7u);
}

TEST(StepPlan, has_gyroscopic_torque_only_for_bodies_whose_inertia_differs_by_axis) {
  EXPECT_TRUE(StepPlan(support::free_box()).has(EffectId::gyroscopic_torque));
  EXPECT_FALSE(StepPlan(support::box_over_ground(1)).has(EffectId::gyroscopic_torque));  // a cube
  EXPECT_FALSE(StepPlan(support::pendulum(1, 0)).has(EffectId::gyroscopic_torque));      // a ball
}

TEST(StepPlan, sees_ahead_of_what_moves_and_can_collide) {
  model::Model model = support::box_over_ground(1);
  EXPECT_TRUE(StepPlan(model).has(EffectId::fast_bodies));
  model.effects = {{"collision", false}};
  EXPECT_FALSE(StepPlan(model).has(EffectId::fast_bodies));
}

TEST(StepPlan, damps_only_by_damping) {
  model::Model model = support::box_over_ground(1);
  EXPECT_FALSE(StepPlan(model).has(EffectId::damping));
  model.angular_damping = 0.1;
  EXPECT_TRUE(StepPlan(model).has(EffectId::damping));
}

TEST(StepPlan, crosses_spaces_only_if_bodies_move_in_two) {
  model::Model model = support::pile(2);
  model.spaces = {"ground", "pile", "empty"};
  for (model::Geom& geom : model.geoms) geom.space = geom.body == model::no_body ? 0 : 1;
  EXPECT_FALSE(StepPlan(model).has(EffectId::cross_space));
  model.geoms.back().space = 2;
  EXPECT_TRUE(StepPlan(model).has(EffectId::cross_space));
}

TEST(StepPlan, has_what_is_demanded_and_lacks_what_is_left_out) {
  model::Model model = support::box_over_ground(0);
  model.effects = {{"restitution", true}, {"gravity", false}, {"friction", true}};
  EXPECT_EQ(pass_names(model), (Names{"collision", "fast_bodies", "friction", "restitution"}));
  const StepPlan plan(model);
  EXPECT_TRUE(plan.is_idle(EffectId::restitution));
  EXPECT_FALSE(plan.is_idle(EffectId::friction));  // the model calls for it
  EXPECT_FALSE(plan.is_idle(EffectId::gravity));
}

TEST(StepPlan, has_a_field_of_interest_where_the_model_has) {
  model::Model model = support::pile(3);
  EXPECT_FALSE(StepPlan(model).has(EffectId::field_of_interest));
  model.effects["field_of_interest"] = true;
  EXPECT_TRUE(StepPlan(model).is_idle(EffectId::field_of_interest));
  model.effects.clear();
  model.interest = model::Interest{{1, 2, 0.5}, model::no_body, 7, 3};
  const auto reason = [&] {
    const StepPlan plan(model);
    for (const Pass& pass : plan.passes()) {
      if (pass.effect->id == EffectId::field_of_interest) return pass.reason.text();
    }
    return std::string();
  };
  EXPECT_EQ(reason(), "within 7 m of [1, 2, 0.5]; elsewhere at most 3 iterations");
  model.interest->follows = 1;
  EXPECT_EQ(reason(), "within 7 m of 'box1'; elsewhere at most 3 iterations");
  model.effects["field_of_interest"] = false;
  leave_out_effects(model);
  EXPECT_FALSE(model.interest.has_value());
  EXPECT_EQ(reason(), "");
}

TEST(StepPlan, lets_islands_sleep_only_where_a_model_says_so) {
  model::Model model = support::pile(3);
  EXPECT_FALSE(StepPlan(model).has(EffectId::sleeping));
  model.effects["sleeping"] = false;
  EXPECT_FALSE(StepPlan(model).has(EffectId::sleeping));
  model.effects["sleeping"] = true;
  model.sleep.after_s = 2;
  const StepPlan plan(model);
  EXPECT_FALSE(plan.is_idle(EffectId::sleeping));
  EXPECT_EQ(plan.passes().back().reason.text(), "after 2 s below 0.05 m/s and 0.1 rad/s");
}

TEST(StepPlan, has_nothing_of_contacts_without_collision) {
  model::Model model = support::pile(3);
  model.effects = {{"collision", false}};
  EXPECT_EQ(pass_names(model), Names{"gravity"});
}

TEST(StepPlan, says_why) {
  const StepPlan plan(support::crash());
  for (const Pass& pass : plan.passes()) EXPECT_FALSE(pass.reason.text().empty()) << pass.effect->name;
  const auto joints = std::find_if(plan.passes().begin(), plan.passes().end(),
                                   [](const Pass& pass) { return pass.effect->id == EffectId::joints; });
  ASSERT_NE(joints, plan.passes().end());
  EXPECT_EQ(joints->reason.text(), "34 joints");
}

TEST(EffectRegistry, is_indexed_by_effect_id) {
  for (std::size_t i = 0; i < effect_registry().size(); ++i)
    EXPECT_EQ(static_cast<std::size_t>(effect_registry()[i].id), i) << effect_registry()[i].name;
}

}  // namespace
}  // namespace pbmpi::effects
