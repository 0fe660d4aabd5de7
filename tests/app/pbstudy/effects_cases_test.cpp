#include "app/pbstudy/effects/effects_cases.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "app/pbstudy/effects/effects_runner.h"
#include "core/error.h"

namespace pbmpi::app {
namespace {

/// A sphere and a cube over smooth ground, which call for collision and gravity only.
scenes::SceneSource smooth_scene(const std::string& more = "") {
  return {"smooth", "smooth.toml",
          "title = \"smooth\"\n[[actor]]\nname = \"ground\"\ntype = \"ground\"\nmaterial = { mu = 0 }\n"
          "[[actor]]\nname = \"ball\"\ntype = \"sphere\"\nradius = 0.3\nmass = 2\nmaterial = { mu = 0 }\n"
          "position = [0, 0, 0.3]\nvelocity = [1, 0, 0]\n"
          "[[actor]]\nname = \"cube\"\ntype = \"box\"\nsize = [0.4, 0.4, 0.4]\nmass = 3\n"
          "material = { mu = 0 }\nposition = [2, 0, 0.2]\n" +
              more};
}

EffectsOptions options_of(std::vector<std::string> args) { return parse_effects_options(args); }

std::vector<EffectCase> cases_of(const scenes::SceneSource& source, const EffectsOptions& options) {
  return make_effect_cases({study_scene(source, options.overrides)}, options);
}

const EffectCase& find(const std::vector<EffectCase>& cases, const std::string& effect) {
  return *std::find_if(cases.begin(), cases.end(),
                       [&](const EffectCase& one) { return one.effect == effect; });
}

std::string refusal(const std::vector<std::string>& args) {
  try {
    options_of(args);
  } catch (const core::InputError& error) {
    return error.what();
  }
  return "";
}

TEST(EffectCases, every_effect_of_the_registry_has_one_case_a_stepper_and_seeds_follow) {
  const auto cases = cases_of(scenes::find_scene("CrashSk"),
                              options_of({"--precision", "double", "single", "--floor-seeds", "3"}));
  const std::size_t num_effects = effects::effect_registry().size();
  ASSERT_EQ(cases.size(), 3 * (num_effects + 3)) << "quick, sor double, sor single";
  for (std::size_t i = 0; i < num_effects; ++i)
    EXPECT_EQ(cases[i].effect, effects::effect_registry()[i].name);
  std::set<std::uint64_t> seeds;
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(cases[num_effects + i].kind, EffectCaseKind::floor);
    EXPECT_TRUE(cases[num_effects + i].choices().empty());
    seeds.insert(cases[num_effects + i].stepper.seed);
  }
  EXPECT_EQ(seeds, (std::set<std::uint64_t>{2, 3, 4})) << "the study's own is 1";
}

TEST(EffectCases, what_is_called_for_is_left_out_and_what_is_not_is_demanded) {
  const auto cases = cases_of(smooth_scene(), options_of({}));
  const EffectCase &gravity = find(cases, "gravity"), &friction = find(cases, "friction");
  EXPECT_EQ(gravity.kind, EffectCaseKind::left_out);
  EXPECT_EQ(gravity.choices(), (model::EffectChoices{{"gravity", false}}));
  EXPECT_TRUE(gravity.called_for);
  EXPECT_EQ(friction.kind, EffectCaseKind::demanded);
  EXPECT_EQ(friction.choices(), (model::EffectChoices{{"friction", true}}));
  EXPECT_FALSE(friction.called_for);
  EXPECT_EQ(friction.reason, "nothing calls for it");
}

TEST(EffectCases, a_field_of_interest_is_left_out_where_a_scene_has_one) {
  const auto cases = cases_of(smooth_scene("[interest]\nfollows = \"ball\"\nradius = 1\n"), options_of({}));
  const EffectCase& field = find(cases, "field_of_interest");
  EXPECT_EQ(field.kind, EffectCaseKind::left_out);
  EXPECT_TRUE(field.called_for);
  EXPECT_EQ(field.reason, "within 1 m of 'ball'; elsewhere at most 4 iterations");
}

TEST(EffectCases, what_cannot_be_left_out_is_recorded_with_the_reason) {
  const EffectCase joints = find(cases_of(scenes::find_scene("CrashSk"), options_of({})), "joints");
  EXPECT_EQ(joints.kind, EffectCaseKind::refused);
  EXPECT_TRUE(joints.called_for);
  EXPECT_NE(joints.reason.find("34 joints hold the bodies"), std::string::npos) << joints.reason;
  EXPECT_TRUE(joints.choices().empty());
}

TEST(EffectCases, the_choices_of_the_scene_file_are_turned_round) {
  const auto cases = cases_of(smooth_scene("[effects]\ngravity = false\nfriction = true\n"), options_of({}));
  const EffectCase &gravity = find(cases, "gravity"), &friction = find(cases, "friction");
  EXPECT_EQ(gravity.kind, EffectCaseKind::demanded) << "the scene leaves it out";
  EXPECT_TRUE(gravity.called_for);
  EXPECT_EQ(friction.kind, EffectCaseKind::left_out) << "the scene demands it";
  EXPECT_FALSE(friction.called_for);
  EXPECT_NE(gravity.reason.find("; the scene leaves it out"), std::string::npos) << gravity.reason;
}

TEST(EffectCases, what_comes_only_on_request_is_called_for_by_a_scene_that_asks_for_it_alone) {
  const EffectCase without = find(cases_of(smooth_scene(), options_of({})), "sleeping");
  EXPECT_EQ(without.kind, EffectCaseKind::demanded);
  EXPECT_FALSE(without.called_for);
  EXPECT_EQ(without.reason, "only on request; after 0.5 s below 0.05 m/s and 0.1 rad/s");
  const EffectCase with =
      find(cases_of(smooth_scene("[effects]\nsleeping = true\n"), options_of({})), "sleeping");
  EXPECT_EQ(with.kind, EffectCaseKind::left_out);
  EXPECT_TRUE(with.called_for);
  EXPECT_EQ(with.reason, "after 0.5 s below 0.05 m/s and 0.1 rad/s");
}

TEST(EffectCases, the_reasons_count_all_worlds) {
  const auto cases = cases_of(scenes::find_scene("100CrSk"), options_of({"--replicas", "3"}));
  EXPECT_EQ(find(cases, "friction").reason, "117 geoms with mu > 0, in 3 worlds");
}

TEST(EffectCases, an_effect_is_named_as_in_the_registry) {
  EXPECT_EQ(options_of({"--effect", "gravity", "friction"}).effects,
            (std::vector<std::string>{"friction", "gravity"}))
      << "in the registry's order";
  EXPECT_NE(refusal({"--effect", "fricton"}).find("did you mean 'friction'?"), std::string::npos);
}

TEST(EffectCases, all_is_every_scene) {
  EXPECT_EQ(options_of({"--scene", "all"}).scenes.size(), 9u);
  EXPECT_EQ(options_of({}).scenes.size(), 9u);
}

TEST(EffectCases, bad_values_are_named) {
  EXPECT_NE(refusal({"--repeats", "0"}).find("--repeats"), std::string::npos);
  EXPECT_NE(refusal({"--floor-seeds", "0"}).find("--floor-seeds"), std::string::npos);
  EXPECT_NE(refusal({"--iterations", "0"}).find("--iterations"), std::string::npos);
  EXPECT_NE(refusal({"--frames", "0"}).find("--frames"), std::string::npos);
  EXPECT_NE(refusal({"--stepper", "fast"}).find("quick, direct, sor"), std::string::npos);
}

EffectResult result_of(const std::string& effect, int repeats) {
  const EffectsOptions options = options_of({"--stepper", "sor", "--frames", "3", "--effect", effect});
  const StudyScene scene = study_scene(smooth_scene(), options.overrides);
  const EffectCase one = make_effect_cases({scene}, options).front();
  return run_effect_case(one, scene, make_reference(scene, one.stepper), one.stepper, repeats);
}

TEST(EffectRunner, demanding_what_nothing_calls_for_changes_no_bit) {
  for (const char* effect : {"friction", "restitution", "gyroscopic_torque"}) {
    const EffectResult result = result_of(effect, 1);
    EXPECT_NE(result.hash_baseline, 0u);
    EXPECT_EQ(result.hash_variant, result.hash_baseline) << effect;
    EXPECT_EQ(result.defect.body_position.max, 0) << effect;
    EXPECT_EQ(result.drift.body_position.max, 0) << effect;
  }
}

TEST(EffectRunner, the_errors_of_a_world_without_weight_are_those_of_a_free_fall) {
  // The bodies rest on the ground: without gravity nothing moves them; with it the contacts' softness does,
  // by far less than a fall of one frame (4.4 mm).
  const EffectResult gravity = result_of("gravity", 1);
  EXPECT_NE(gravity.hash_variant, gravity.hash_baseline);
  EXPECT_LT(gravity.defect.body_position.max, 4.4e-3);
  // Without collision they fall: from each frame's start on the ground by 9.81 h^2 (1 + 2 + ... + 24) m in
  // the 24 substeps h of the first-order integrator, if the velocity is zero at the start.
  const EffectResult collision = result_of("collision", 1);
  EXPECT_NEAR(collision.defect.body_position.max, 9.81 * 0.00125 * 0.00125 * 300, 1e-3)
      << "a body at rest sinks a little";
  EXPECT_EQ(collision.defect.body_position.count, 3 * 2) << "three frames of two bodies";
  EXPECT_EQ(collision.drift.body_position.count, 2) << "after the last frame";
  EXPECT_GT(collision.drift.body_position.rms, collision.defect.body_position.rms);
}

TEST(EffectRunner, repeats_change_times_only) {
  const EffectResult once = result_of("collision", 1), thrice = result_of("collision", 3);
  EXPECT_EQ(once.defect.body_position.rms, thrice.defect.body_position.rms);
  EXPECT_EQ(once.hash_variant, thrice.hash_variant);
  for (const EffectResult& result : {once, thrice}) {
    EXPECT_GT(result.time_with_s.median, 0);
    EXPECT_LE(result.cost_s.p10, result.cost_s.median);
    EXPECT_LE(result.cost_s.median, result.cost_s.p90);
    EXPECT_LE(result.share.median, 1);
  }
}

}  // namespace
}  // namespace pbmpi::app
