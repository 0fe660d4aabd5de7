// Forcing an effect that nothing calls for changes the time, but not a bit of a state.
#include "effects/effects.h"

#include <array>
#include <set>
#include <string>

#include <gtest/gtest.h>

#include "../helpers.h"
#include "model/state.h"
#include "ode/collide/narrow_phase.h"
#include "ode/ode_stepper.h"
#include "solver/worlds/sor_stepper.h"
#include "stepping/stepper_traits.h"

namespace pbmpi::scenes {
namespace {

using model::EffectChoices;
using stepping::StepperKind;

/// Balls and a cube that fall on smooth ground, and a door on a hinge: a world that calls for little.
SceneSource smooth_scene() {
  const auto ball = [](const char* name, const char* position, const char* more) {
    return std::string("[[actor]]\nname = \"") + name + "\"\ntype = \"sphere\"\nradius = 0.3\nmass = 2\n" +
           "material = { mu = 0 }\nposition = " + position + "\n" + more;
  };
  return {"smooth", "smooth.toml",
          "title = \"smooth\"\n[[actor]]\nname = \"ground\"\ntype = \"ground\"\nmaterial = { mu = 0 }\n" +
              ball("a", "[0, 0, 0.31]", "angular_velocity = [1, 2, 3]\n") +
              ball("b", "[0.1, 0, 0.95]", "velocity = [0.5, 0, -1]\n") + ball("c", "[0.2, 0.1, 1.6]", "") +
              "[[actor]]\nname = \"cube\"\ntype = \"box\"\nsize = [0.4, 0.4, 0.4]\nmass = 3\n"
              "material = { mu = 0 }\nangular_velocity = [3, 1, 2]\nposition = [2, 0, 0.5]\n"
              "[[actor]]\nname = \"door\"\ntype = \"box\"\nsize = [0.5, 0.5, 0.5]\nmass = 4\n"
              "material = { mu = 0 }\nposition = [4, 0, 1]\nangular_velocity = [0, 0, 1]\n"
              "[[joint]]\nname = \"hinge\"\nkind = \"hinge\"\nbodies = [\"door\", \"world\"]\n"
              "anchor = [3.7, 0, 1]\naxis = [0, 0, 1]\n"};
}

/// A ball that flies alone: a world that calls for nothing.
SceneSource lonely_scene() {
  return {
      "lonely", "lonely.toml",
      "title = \"lonely\"\ngravity = [0, 0, 0]\n[[actor]]\nname = \"ball\"\ntype = \"sphere\"\n"
      "radius = 0.3\nmass = 2\nposition = [0, 0, 1]\nvelocity = [1, 2, 3]\nangular_velocity = [1, 2, 3]\n"};
}

constexpr std::array suite = {"2-Cars",  "10-Cars", "CrashSk", "CrashWa", "Environ",
                              "100CrSk", "Battle",  "Fight",   "Battle2"};

std::unique_ptr<stepping::WorldStepper> make_stepper(const RunDefaults& defaults, StepperKind kind) {
  stepping::StepperSettings settings = default_settings(kind, stepping::Law::ode);
  settings.dt_s = defaults.dt_s;
  settings.iterations = defaults.iterations;
  if (kind == StepperKind::sor) return solver::make_sor_stepper(settings, ode::make_narrow_phase);
  return ode::make_ode_stepper(settings, [](const std::string&) {});
}

std::uint64_t hash_after(const SceneSource& source, const EffectChoices& effects, StepperKind kind,
                         int num_steps) {
  const auto scene = parse_scene(source, {}, effects);
  const auto stepper = make_stepper(scene->defaults(), kind);
  const auto model = scene->build(0, 1);
  stepper->add(0, model, model::initial_state(*model), 0);
  core::PhaseTimes times;
  stepper->advance(num_steps, times);
  EXPECT_EQ(stepper->observables(0).nonfinite, 0);
  return model::hash(stepper->state(0));
}

/// The effects of the registry that world 0 does not call for.
std::vector<std::string> unneeded(const SceneSource& source) {
  const effects::StepPlan plan(*parse_scene(source)->build(0, 1));
  std::vector<std::string> names;
  for (const effects::Effect& effect : effects::effect_registry()) {
    if (!plan.has(effect.id)) names.emplace_back(effect.name);
  }
  return names;
}

void expect_same_bits(const SceneSource& source, int num_steps) {
  for (const StepperKind kind : {StepperKind::quick, StepperKind::sor}) {
    const std::uint64_t plain = hash_after(source, {}, kind, num_steps);
    EffectChoices all;
    for (const std::string& name : unneeded(source)) {
      all[name] = true;
      EXPECT_EQ(hash_after(source, {{name, true}}, kind, num_steps), plain) << name;
    }
    EXPECT_EQ(hash_after(source, all, kind, num_steps), plain) << "all of them";
  }
}

class UnneededEffect : public testing::TestWithParam<const char*> {};

// Seven of the run's eight frames: through the action that the measured window covers.
TEST_P(UnneededEffect, changes_no_bit_where_it_is_demanded) {
  const SceneSource source = find_scene(GetParam());
  EXPECT_FALSE(unneeded(source).empty());
  expect_same_bits(source, 21);
}

INSTANTIATE_TEST_SUITE_P(PhysicsBench, UnneededEffect, testing::ValuesIn(suite), [](const auto& test) {
  std::string name = test.param;
  std::erase(name, '-');
  return name;
});

// The nine scenes all call for friction and gyroscopic torque; this one calls for neither, nor for limits or
// motors on its hinge.
TEST(UnneededEffect, changes_no_bit_of_a_world_that_calls_for_little) {
  const auto names = unneeded(smooth_scene());
  for (const char* name : {"friction", "gyroscopic_torque", "limits", "motors", "restitution"})
    EXPECT_NE(std::find(names.begin(), names.end(), name), names.end()) << name;
  expect_same_bits(smooth_scene(), 120);
}

TEST(UnneededEffect, changes_no_bit_without_weight) {
  SceneSource source = smooth_scene();
  source.text = "gravity = [0, 0, 0]\n" + source.text;
  const auto names = unneeded(source);
  EXPECT_NE(std::find(names.begin(), names.end(), "gravity"), names.end());
  expect_same_bits(source, 120);
}

TEST(UnneededEffect, changes_no_bit_of_a_world_that_calls_for_nothing) {
  EXPECT_EQ(unneeded(lonely_scene()).size(), effects::effect_registry().size());
  expect_same_bits(lonely_scene(), 120);
}

// The lone ball calls for nothing, which proves little of what the solver would do with contacts and joints.
TEST(UnneededEffect, is_tried_in_one_of_the_nine_for_all_that_not_each_of_them_needs) {
  std::set<std::string> tried;
  for (const char* scene : suite) {
    const auto names = unneeded(find_scene(scene));
    tried.insert(names.begin(), names.end());
  }
  for (const char* name : {"cross_space", "field_of_interest", "breakable_joints", "sleeping", "events",
                           "steering", "motors", "suspension", "restitution", "damping", "drag"})
    EXPECT_EQ(tried.count(name), 1u) << name;
}

// An effect that is called for must not be dropped silently: each of these changes the bits of the same few
// steps.
TEST(CalledForEffect, changes_the_result_when_it_is_left_out) {
  for (const StepperKind kind : {StepperKind::quick, StepperKind::sor}) {
    const SceneSource source = find_scene("CrashSk");
    const std::uint64_t plain = hash_after(source, {}, kind, 21);
    for (const char* name :
         {"collision", "friction", "limits", "motors", "suspension", "gyroscopic_torque", "gravity"}) {
      EXPECT_NE(hash_after(source, {{name, false}}, kind, 21), plain) << name;
    }
  }
}

TEST(SceneEffects, are_chosen_by_the_file_and_overridden_by_the_caller) {
  SceneSource source = smooth_scene();
  source.text += "[effects]\nrestitution = true\ngravity = false\n";
  const EffectChoices file = {{"restitution", true}, {"gravity", false}};
  EXPECT_EQ(parse_scene(source)->defaults().effects, file);
  EXPECT_TRUE(parse_scene(source)->build(0, 1)->gravity.isZero());
  const auto scene = parse_scene(source, {}, {{"gravity", true}});
  EXPECT_FALSE(scene->build(0, 1)->gravity.isZero());
  EXPECT_TRUE(scene->defaults().effects.at("restitution"));
}

TEST(SceneEffects, refuse_a_name_that_is_none_at_its_place) {
  const std::string error = error_of(smooth_scene().text + "[effects]\nfrictoin = true\n");
  EXPECT_NE(error.find("test.toml:"), std::string::npos) << error;
  EXPECT_NE(error.find("did you mean 'friction'?"), std::string::npos) << error;
}

}  // namespace
}  // namespace pbmpi::scenes
