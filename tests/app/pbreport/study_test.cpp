#include <gtest/gtest.h>

#include "app/common/quantities.h"
#include "app/pbreport/accuracy/study_data.h"
#include "app/pbreport/accuracy/study_options.h"
#include "app/pbreport/accuracy/study_text.h"
#include "core/error.h"
#include "stepping/step_options.h"

namespace pbmpi::app {
namespace {

StudyCase setting(double time_ms, double error_mm) {
  StudyCase one;
  one.scene = "Fake";
  one.kind = "setting";
  one.stepper.kind = stepping::StepperKind::sor;
  one.stepper.precision = stepping::Precision::single;
  one.stepper.substeps = 2;
  one.stepper.iterations = 3;
  one.steps_per_frame = 3;
  one.frames = 5;
  one.time_s = 1e-3 * time_ms;
  one.defect.body_position.rms = 1e-3 * error_mm;
  one.defect.body_position.bands = {1, 0, 0, 0, 0};
  return one;
}

SceneCases scene() {
  SceneCases cases;
  cases.name = "Fake";
  //                         0              1              2 (dominated)   3              4 (as 3, dearer)  5
  cases.settings = {setting(4, 2), setting(1, 10), setting(2, 12),
                    setting(2, 5), setting(3, 5),  setting(0.5, 8)};
  cases.settings[5].defect.joint_position.bands = {0, 0, 0, 0, 1};  // a joint is NaN
  cases.floor = {setting(9, 0.5), setting(9, 2.5)};
  return cases;
}

TEST(Study, the_front_holds_what_nothing_beats_and_its_error_falls) {
  EXPECT_EQ(scene().pareto_front(ErrorMeasure::rms), (std::vector<std::size_t>{1, 3, 0}));
}

TEST(Study, what_blew_up_is_never_chosen_however_fast) {
  SceneCases cases = scene();
  EXPECT_FALSE(cases.settings[5].finite());
  cases.settings[5].defect.joint_position.bands = {};
  EXPECT_EQ(cases.pareto_front(ErrorMeasure::rms), (std::vector<std::size_t>{5, 3, 0}));
}

TEST(Study, a_budget_takes_the_least_error_and_a_tolerance_the_least_time) {
  const SceneCases cases = scene();
  EXPECT_EQ(cases.best_within(3.5e-3, ErrorMeasure::rms), 3u);
  EXPECT_EQ(cases.best_within(1, ErrorMeasure::rms), 0u);
  EXPECT_EQ(cases.best_within(0.6e-3, ErrorMeasure::rms), std::nullopt);
  EXPECT_EQ(cases.cheapest_within(6e-3, ErrorMeasure::rms), 3u);
  EXPECT_EQ(cases.cheapest_within(1e-3, ErrorMeasure::rms), std::nullopt);
}

TEST(Study, what_fells_at_rest_is_never_chosen_but_stays_on_the_front) {
  SceneCases cases = scene();
  cases.settings[3].rest_fallen = 2;
  cases.settings[0].rest_fallen = 0;
  EXPECT_EQ(cases.pareto_front(ErrorMeasure::rms), (std::vector<std::size_t>{1, 3, 0}));
  EXPECT_EQ(cases.standing_front(ErrorMeasure::rms), (std::vector<std::size_t>{1, 4, 0}));
  EXPECT_EQ(cases.best_within(2.5e-3, ErrorMeasure::rms), 1u);
  EXPECT_EQ(cases.cheapest_within(6e-3, ErrorMeasure::rms), 4u);
  EXPECT_FALSE(cases.settings[1].fells()) << "nothing was watched";
}

TEST(Study, remarks_say_what_falls_and_when) {
  StudyCase one = setting(1, 10);
  EXPECT_EQ(remarks_text(one, false), "");
  EXPECT_EQ(remarks_text(one, true), "at the noise floor");
  one.rest_fallen = 12;
  one.rest_fell_at_s = 1.25;
  EXPECT_EQ(remarks_text(one, true), "fells 12 bodies at rest, the first after 1.25 s; at the noise floor");
}

TEST(Study, the_noise_floor_is_that_of_the_worst_seed) {
  EXPECT_EQ(scene().floor_m(ErrorMeasure::rms), 2.5e-3);
}

TEST(Study, the_reference_is_known_to_the_worst_of_its_yardsticks_but_for_the_steps_length) {
  SceneCases cases = scene();
  EXPECT_EQ(cases.uncertainty_m(ErrorMeasure::rms), 2.5e-3) << "the noise floor";
  cases.more_iterations = setting(90, 1);
  cases.second_method = setting(90, 4);
  cases.halved_dt = setting(90, 30);
  EXPECT_EQ(cases.uncertainty_m(ErrorMeasure::rms), 4e-3);
  const AccuracyReportOptions by_rms;
  EXPECT_TRUE(is_inside(cases, cases.settings[0], by_rms)) << "2 mm";
  EXPECT_EQ(inside_text(cases, cases.settings[0], by_rms),
            ": within the 4 mm to which the reference is known");
  EXPECT_FALSE(is_inside(cases, cases.settings[3], by_rms)) << "5 mm";
  EXPECT_EQ(inside_text(cases, cases.settings[3], by_rms), "");
}

TEST(Study, a_setting_becomes_the_options_that_give_it) {
  const std::string config = config_text(setting(1, 10));
  for (const char* line : {"scene = Fake\n", "stepper = sor\n", "substeps = 2\n", "iterations = 3\n",
                           "precision = single\n", "steps-per-frame = 3\n"}) {
    EXPECT_NE(config.find(line), std::string::npos) << line;
  }
  StudyCase quick = setting(1, 10);
  quick.stepper.kind = stepping::StepperKind::quick;
  EXPECT_EQ(config_text(quick).find("substeps ="), std::string::npos) << "ODE's steppers refuse it";
}

TEST(Study, the_text_of_a_setting_leaves_out_what_all_have_in_common) {
  StudyCase one = setting(1, 10);
  one.stepper = default_settings(stepping::StepperKind::sor);
  one.stepper.precision = stepping::Precision::single;
  EXPECT_EQ(setting_text(one), "sor single, 14 x 1, dt 0.01 s");
  one.stepper.iterations = 3;
  one.stepper.law = stepping::ode_law();
  one.estimate_iterations = 2;
  EXPECT_EQ(setting_text(one), "sor single, 14 x 3, law ode, 2 a step, dt 0.01 s");
  one.is_look = true;
  one.estimate_after = 1;
  EXPECT_EQ(setting_text(one), "sor single, 14 x 3, law ode, look at 2 after 1 step, dt 0.01 s");
  one.stepper = default_settings(stepping::StepperKind::direct);
  one.estimate_iterations = 0;
  EXPECT_EQ(setting_text(one), "direct, dt 0.01 s");
}

TEST(StudyOptions, times_and_lengths_have_units) {
  EXPECT_DOUBLE_EQ(parse_time_s("3.33ms", "--budget"), 3.33e-3);  // one rounding of the product
  EXPECT_DOUBLE_EQ(parse_time_s("500us", "--budget"), 5e-4);
  EXPECT_EQ(parse_time_s("2s", "--budget"), 2);
  EXPECT_DOUBLE_EQ(parse_length_m("1cm", "--tolerance"), 0.01);
  for (const char* text : {"", "3", "ms", "-1ms", "0ms", "3.33 ms", "3mss", "nanms", "infms"}) {
    EXPECT_THROW(parse_time_s(text, "--budget"), core::InputError) << text;
  }
}

std::string refusal(std::vector<std::string> args) {
  try {
    parse_study_options(args);
  } catch (const core::InputError& error) {
    return error.what();
  }
  return "";
}

TEST(StudyOptions, contradictions_are_refused) {
  EXPECT_NE(refusal({}).find("no file"), std::string::npos);
  EXPECT_NE(refusal({"a.h5", "b.h5"}).find("one study"), std::string::npos);
  EXPECT_NE(refusal({"a.h5", "--budget", "1ms", "--tolerance", "1cm"}).find("exclude"), std::string::npos);
  EXPECT_NE(refusal({"a.h5", "--write-config", "p"}).find("--budget"), std::string::npos);
  EXPECT_NE(refusal({"a.h5", "--measure", "mean"}).find("rms, p99, max or joint"), std::string::npos);
  EXPECT_NE(refusal({"a.h5", "--budget", "3.33"}).find("unit"), std::string::npos);
  EXPECT_NE(refusal({"a.h5", "--html", "a.h5"}).find("to be read"), std::string::npos);
  EXPECT_EQ(refusal({"a.h5", "--budget", "3.33ms", "--write-config", "p"}), "");
}

}  // namespace
}  // namespace pbmpi::app
