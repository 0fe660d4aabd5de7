#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <fstream>

#include "app/pbreport/effects/effects_data.h"
#include "app/pbreport/effects/effects_markdown.h"
#include "app/pbreport/effects/effects_page.h"
#include "app/pbreport/effects/effects_text.h"
#include "app/pbreport/study/study_report.h"
#include "core/error.h"

namespace pbmpi::app {
namespace {

EffectRow row(const std::string& effect, bool called_for, bool same_bits, double share) {
  EffectRow one;
  one.effect = effect;
  one.kind = called_for ? "left_out" : "demanded";
  one.called_for = called_for;
  one.reason = called_for ? "3 things" : "nothing calls for it";
  one.same_bits = same_bits;
  one.share = {share, share, share};
  return one;
}

TEST(EffectsReport, the_noise_floor_is_the_largest_of_the_seeds_in_either_direction) {
  EffectScene scene{"Fake", "quick", {}, {row("", false, false, 0.01), row("", false, false, -0.03)}};
  scene.floor[0].defect.body_position.rms = 2e-3;
  scene.floor[1].drift.body_position.rms = 5e-3;
  EXPECT_EQ(scene.floor_share(), 0.03);
  EXPECT_EQ(scene.floor_defect_m(), 2e-3);
  EXPECT_EQ(scene.floor_drift_m(), 5e-3);
}

TEST(EffectsReport, says_when_an_unneeded_effect_changed_the_result) {
  EXPECT_EQ(note_of(row("friction", false, true, 0)), "demanded: nothing calls for it; no bit changes");
  EXPECT_NE(note_of(row("friction", false, false, 0)).find("AND YET THE RESULT CHANGES"), std::string::npos);
  EXPECT_EQ(note_of(row("friction", true, false, 0)), "left out: 3 things");
}

TEST(EffectsReport, instructions_give_a_share_only_where_both_were_counted) {
  EffectRow one = row("friction", true, false, 0.5);
  EXPECT_EQ(one.instruction_share(), std::nullopt);
  one.instructions_with = 400;
  one.instructions_without = 300;
  EXPECT_EQ(one.instruction_share(), 0.25);
}

TEST(EffectsReport, shares_are_percent_and_nothing_is_a_dash) {
  EXPECT_EQ(percent_text(0.572), "57.2 %");
  EXPECT_EQ(percent_text(-0.0001), "0.0 %");
  EXPECT_EQ(percent_text(NAN), "-");
}

TEST(EffectsMarkdown, has_a_table_a_stepper_with_costs_errors_and_the_floor) {
  EffectScene crash{
      "Crash", "quick", {row("friction", true, false, 0.154), row("joints", true, true, 0)}, {}};
  crash.effects[0].defect.body_position.rms = 0.0441;
  crash.effects[1].same_bits.reset();  // refused
  crash.floor = {row("", false, false, -0.021)};
  crash.floor[0].defect.body_position.rms = 2.3e-4;
  EffectScene cars{"Cars", "quick", {row("friction", false, true, 0.019), row("joints", true, true, 0)}, {}};
  cars.effects[1].same_bits.reset();
  EffectScene single = crash;
  single.stepper = "sor single";
  single.effects[0].defect.body_position.rms = 4e-6;
  EXPECT_EQ(effects_to_markdown({crash, cars, single}),
            "| `quick` | Crash | Cars |\n|---|---|---|\n"
            "| `friction` | 15, 44 mm | (2) |\n"
            "| noise floor | 2, 0.2 mm | 0, 0 |\n"
            "\n| `sor single` | Crash |\n|---|---|\n"
            "| `friction` | 15, 0 |\n"
            "| noise floor | 2, 0.2 mm |\n");
}

TEST(EffectsReport, what_comes_only_on_request_is_demanded_in_every_form_of_the_report) {
  EffectRow sleeping = row("sleeping", false, false, 0.1);
  sleeping.reason = "only on request; after 0.5 s";
  for (const bool called_for : {false, true}) {  // files of layout 1.2 say that it is called for
    sleeping.called_for = called_for;
    EXPECT_EQ(note_of(sleeping), "demanded: only on request; after 0.5 s");
    const EffectScene scene{"Crash", "quick", {sleeping}, {}};
    EXPECT_NE(effects_to_markdown({scene}).find("| (10), other bits |"), std::string::npos);
    const std::string path = testing::TempDir() + "effects_test.html";
    write_effects_page(path, {}, {scene}, {});
    std::ifstream page(path);
    const std::string text(std::istreambuf_iterator<char>(page), {});
    EXPECT_NE(text.find("(10.0 %), other bits"), std::string::npos);
    std::remove(path.c_str());
  }
}

TEST(EffectsMarkdown, shows_it_if_demanding_changed_the_result) {
  const EffectScene scene{"Crash", "quick", {row("damping", false, false, -0.001)}, {}};
  EXPECT_NE(effects_to_markdown({scene}).find("| `damping` | (0), other bits |"), std::string::npos);
}

std::string refusal(const std::vector<std::string>& args) {
  try {
    parse_options({"effects", "costs", "a page", "a table"}, args);
  } catch (const core::InputError& error) {
    return error.what();
  }
  return "";
}

TEST(EffectsReportOptions, contradictions_are_refused) {
  EXPECT_NE(refusal({}).find("no file"), std::string::npos);
  EXPECT_NE(refusal({"a.h5", "b.h5"}).find("one study"), std::string::npos);
  EXPECT_NE(refusal({"a.h5", "--csv", "a.h5"}).find("to be read"), std::string::npos);
  EXPECT_NE(refusal({"a.h5", "--json", "--markdown"}).find("one of the two"), std::string::npos);
  EXPECT_EQ(refusal({"a.h5", "--html", "a.html"}), "");
}

}  // namespace
}  // namespace pbmpi::app
