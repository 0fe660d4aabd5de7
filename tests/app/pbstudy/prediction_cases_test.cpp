#include "app/pbstudy/prediction/prediction_cases.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/error.h"

namespace pbmpi::app {
namespace {

std::vector<PredictionCase> cases_of(const std::vector<std::string>& args) {
  const PredictionOptions options = parse_prediction_options(args);
  std::vector<StudyScene> scenes;
  for (const std::string& name : options.scenes)
    scenes.push_back(study_scene(scenes::find_scene(name), options.overrides));
  return make_prediction_cases(scenes, options);
}

std::vector<std::string> names_of(const std::vector<PredictionCase>& cases) {
  std::vector<std::string> names;
  for (const PredictionCase& one : cases) names.push_back(one.name);
  return names;
}

TEST(PredictionCases, are_figure_8_then_the_other_thresholds_then_sor) {
  const auto cases = cases_of({"--scene", "2-Cars"});
  EXPECT_EQ(names_of(cases), (std::vector<std::string>{"20Iter", "19Iter", "FEEC", "FEEC+FVP6", "FVP6",
                                                       "FVP8", "FVP10", "FVP12", "sor", "sor FVP6"}));
  EXPECT_EQ(cases[0].threshold, 0);
  EXPECT_EQ(cases[1].iterations, 19);
  EXPECT_TRUE(cases[2].feec);
  EXPECT_TRUE(cases[4].has_cycles);
  EXPECT_FALSE(cases[5].has_cycles) << "in the full form only";
  EXPECT_EQ(cases[8].stepper, "sor");
  EXPECT_EQ(cases[8].scope, "all");
}

TEST(PredictionCases, have_quick_in_single_precision_where_the_build_has_it) {
  PredictionOptions options = parse_prediction_options({"--scene", "2-Cars"});
  options.has_ode_single = true;
  const auto cases =
      make_prediction_cases({study_scene(scenes::find_scene("2-Cars"), options.overrides)}, options);
  ASSERT_EQ(cases.size(), 12U);
  EXPECT_EQ(cases[10].name, "single");
  EXPECT_EQ(cases[11].name, "single FVP6");
  for (const std::size_t i : {std::size_t{10}, std::size_t{11}}) {
    EXPECT_EQ(cases[i].program, ode_single_program);
    EXPECT_EQ(cases[i].precision, "single");
    EXPECT_EQ(cases[i].stepper, "quick");
    EXPECT_EQ(cases[i].iterations, cases[0].iterations);
  }
}

TEST(PredictionCases, have_single_phases_and_variants_in_the_scene_of_details) {
  const auto cases = cases_of({"--scene", "CrashSk", "2-Cars", "--threshold", "1e-9"});
  const auto names = names_of(cases);
  EXPECT_EQ(std::ranges::count(names, "FVP9 collision"), 1);
  EXPECT_EQ(std::ranges::count(names, "FVP9 step"), 1);
  EXPECT_EQ(std::ranges::count_if(cases, &PredictionCase::has_variants), 2);
  EXPECT_EQ(std::ranges::count_if(cases_of({"--scene", "CrashSk", "--detail-scene", "none"}),
                                  &PredictionCase::has_variants),
            0);
}

TEST(PredictionCases, in_full_have_cycles_everywhere) {
  for (const PredictionCase& one : cases_of({"--scene", "CrashSk", "--full"}))
    EXPECT_TRUE(one.has_cycles) << one.name;
}

TEST(PredictionCases, thresholds_are_named_by_their_power_of_ten) {
  EXPECT_EQ(name_of_threshold(1e-6), "FVP6");
  EXPECT_EQ(name_of_threshold(1e-12), "FVP12");
  EXPECT_EQ(name_of_threshold(5e-7), "FVP(5e-07)");
}

TEST(PredictionCases, are_dealt_out_to_all_ranks) {
  const auto cases = cases_of({"--scene", "2-Cars"});
  const auto owner = deal_out(cases, 2);
  EXPECT_EQ(owner.size(), cases.size());
  EXPECT_GT(std::ranges::count(owner, 0), 0);
  EXPECT_GT(std::ranges::count(owner, 1), 0);
}

TEST(PredictionOptions, of_no_use_are_refused) {
  EXPECT_THROW(parse_prediction_options({"--threshold", "0"}), core::InputError);
  EXPECT_THROW(parse_prediction_options({"--threshold", "-1e-6"}), core::InputError);
  EXPECT_THROW(parse_prediction_options({"--budget", "0"}), core::InputError);
  EXPECT_THROW(parse_prediction_options({"--time-limit", "0"}), core::InputError);
}

}  // namespace
}  // namespace pbmpi::app
