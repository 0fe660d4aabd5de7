#include "effects/effect_choices.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "effects/effects.h"
#include "support/models.h"

namespace pbmpi::effects {
namespace {

std::string error_of(const std::string& text) {
  try {
    parse_effect_choices(text);
  } catch (const core::InputError& error) {
    return error.what();
  }
  return "";
}

TEST(EffectChoices, are_read_and_written_alike) {
  const model::EffectChoices choices = parse_effect_choices("+restitution,-gravity");
  EXPECT_EQ(choices, (model::EffectChoices{{"gravity", false}, {"restitution", true}}));
  EXPECT_EQ(parse_effect_choices(to_text(choices)), choices);
  EXPECT_EQ(parse_effect_choices(""), model::EffectChoices{});
  EXPECT_EQ(to_text({}), "");
}

TEST(EffectChoices, refuse_what_is_no_choice) {
  EXPECT_NE(error_of("+fricton").find("did you mean 'friction'?"), std::string::npos);
  EXPECT_NE(error_of("-telepathy").find("known: 'events', 'steering'"), std::string::npos);
  EXPECT_NE(error_of("friction").find("write +name"), std::string::npos);
  EXPECT_NE(error_of("+friction,-friction").find("twice"), std::string::npos);
  EXPECT_NE(error_of("+friction,,-gravity"), "");
  EXPECT_NE(error_of("+"), "");
}

/// Every effect except joints can be left out of a model that calls for nearly all of them.
TEST(LeaveOutEffects, takes_from_the_model_what_calls_for_them) {
  for (const Effect& effect : effect_registry()) {
    if (effect.id == EffectId::joints) continue;
    model::Model model = support::crash();
    model.spaces = {"left", "right"};
    model.geoms.front().space = 1;  // the last one is the ground
    model.geoms.front().material.restitution = 0.5;
    model.bodies.front().velocity = {0, 0, -200};
    model.linear_damping = 0.1;
    model.air_density = 1.2;
    model.interest.emplace();
    model.joints.front().break_force = 100;
    for (const model::EventKind kind :
         {model::EventKind::launch, model::EventKind::motor, model::EventKind::steer}) {
      model::Event& event = model.events.emplace_back();
      event.kind = kind;
      event.body = event.joint = 0;
    }
    model.effects["sleeping"] = true;  // only on explicit request
    ASSERT_TRUE(StepPlan(model).has(effect.id)) << effect.name;
    model.effects[std::string(effect.name)] = false;
    leave_out_effects(model);
    EXPECT_FALSE(StepPlan(model).has(effect.id)) << effect.name;
    // Collision, fast bodies and gyroscopic torque are removed from the plan, the other effects from the
    // model itself.
    model.effects.clear();
    EXPECT_EQ(StepPlan(model).has(effect.id), effect.id == EffectId::collision ||
                                                  effect.id == EffectId::fast_bodies ||
                                                  effect.id == EffectId::gyroscopic_torque)
        << effect.name;
  }
}

TEST(LeaveOutEffects, refuses_to_let_a_model_fall_apart) {
  model::Model model = support::crash();
  model.effects["joints"] = false;
  EXPECT_THROW(leave_out_effects(model), core::InputError);
  model::Model loose = support::pile(2);
  loose.effects["joints"] = false;
  EXPECT_NO_THROW(leave_out_effects(loose));
}

TEST(LeaveOutEffects, refuses_friction_without_collision) {
  for (const char* part : {"friction", "restitution", "cross_space", "fast_bodies"}) {
    model::Model model = support::pile(2);
    model.effects = {{"collision", false}, {part, true}};
    EXPECT_THROW(leave_out_effects(model), core::InputError) << part;
  }
}

}  // namespace
}  // namespace pbmpi::effects
