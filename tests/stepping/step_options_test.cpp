#include "stepping/step_options.h"

#include <gtest/gtest.h>

#include <set>

#include "core/error.h"
#include "stepping/names.h"

namespace pbmpi::stepping {
namespace {

std::string refusal(const char* name, const char* text) {
  try {
    StepperSettings settings;
    set(step_option(name), text, "--" + std::string(name), settings);
  } catch (const core::InputError& error) {
    return error.what();
  }
  return "";
}

TEST(StepOptions, every_name_stands_once) {
  std::set<std::string_view> names;
  for (const StepOption& option : step_options()) EXPECT_TRUE(names.insert(option.name).second);
}

TEST(StepOptions, a_value_written_as_text_is_read_back_bit_for_bit) {
  StepperSettings settings = default_settings(StepperKind::direct);
  settings.dt_s = 0.1 + 0.2;  // 0.30000000000000004
  settings.law = SorLaw{};
  settings.iterations = 7;
  settings.substeps = 3;
  settings.tolerance_m = 1.0 / 17;
  settings.approach_m = 1.0 / 13;
  settings.precision = Precision::single;
  settings.simd = Simd::avx2;
  settings.threads = 3;
  settings.seed = 18446744073709551615u;
  StepperSettings again = default_settings(StepperKind::quick);
  for (const StepOption& option : step_options()) {
    EXPECT_EQ(is_default(option, settings), option.name == "stepper") << option.name;
    set(option, given_text(option, settings), "", again);
    EXPECT_EQ(text_of(option, again), text_of(option, settings));
  }
  EXPECT_EQ(again.dt_s, settings.dt_s);
  EXPECT_EQ(again.law, settings.law);
  EXPECT_EQ(again.seed, settings.seed);
}

TEST(StepOptions, shown_defaults_are_values) {
  StepperSettings settings;
  for (const StepOption& option : step_options()) {
    if (option.shown_default.empty()) continue;
    EXPECT_NO_THROW(set(option, option.shown_default, "", settings)) << option.name;
  }
}

TEST(StepOptions, are_by_default_those_of_sor_with_its_soft_law_and_a_text_names_what_differs) {
  StepperSettings settings;
  for (const StepOption& option : step_options()) {
    EXPECT_TRUE(is_default(option, settings)) << option.name;
    EXPECT_EQ(text_of(option, settings), text_of(option, default_settings(StepperKind::sor))) << option.name;
  }
  EXPECT_EQ(setting_text(settings), "sor double, 14 x 1");
  settings.tolerance_m = 0.001;
  settings.substeps = 4;
  EXPECT_EQ(setting_text(settings), "sor double, 4 x 1, tolerance 0.001 m");
  EXPECT_EQ(setting_text(default_settings(StepperKind::sor, Law::ode)), "sor double, 1 x 20, law ode");
  EXPECT_EQ(setting_text(default_settings(StepperKind::sor, Law::coulomb)),
            "sor double, 1 x 20, law coulomb");
  EXPECT_EQ(setting_text(default_settings(StepperKind::quick)), "quick, 1 x 20");
}

TEST(StepOptions, a_law_is_set_by_its_name) {
  StepperSettings settings;
  set(step_option("law"), "ode", "--law", settings);
  EXPECT_EQ(settings.law, ode_law());
  EXPECT_FALSE(is_default(step_option("law"), settings));
  EXPECT_EQ(std::get<std::string>(value_of(step_option("law"), settings)), "ode");
  set(step_option("law"), "soft", "--law", settings);
  EXPECT_EQ(settings.law, SorLaw{});
  EXPECT_EQ(refusal("law", "hard"), "--law hard: it must be one of soft, ode, coulomb");
}

TEST(StepOptions, impossible_values_are_refused_by_name) {
  EXPECT_EQ(refusal("iterations", "0"), "--iterations 0: it must be at least 1");
  EXPECT_EQ(refusal("iterations", "1.5"), "--iterations 1.5: it must be a whole number");
  EXPECT_EQ(refusal("substeps", ""), "--substeps : it must be a whole number");
  EXPECT_EQ(refusal("dt", "nan"),
            "--dt nan: it must be a finite number above 0 with a unit (us, ms, s, min, h), e.g. 10ms");
  EXPECT_EQ(refusal("tolerance", "1km"),
            "--tolerance 1km: it must be a finite number above 0, or 0, with a unit (mm, cm, m), e.g. 0.1mm");
  EXPECT_EQ(refusal("precision", "half"), "--precision half: it must be one of double, single");
  EXPECT_EQ(refusal("solver-seed", "-1"), "--solver-seed -1: it must be a whole number");
}

TEST(StepOptions, a_length_may_have_a_unit) {
  for (const char* text : {"0.1mm", "0.01cm", "0.0001m", "0.0001", "1e-4"}) {
    StepperSettings settings;
    set(step_option("tolerance"), text, "", settings);
    EXPECT_DOUBLE_EQ(settings.tolerance_m, 1e-4) << text;
  }
}

TEST(StepOptions, a_number_that_is_asked_about_is_saved_with_its_unit) {
  StepperSettings settings;
  for (const char* text : {"2cm", "0.02m"}) {
    set(step_option("tolerance"), text, "", settings);
    EXPECT_EQ(given_text(step_option("tolerance"), settings), "0.02m") << text;
    EXPECT_EQ(text_of(step_option("tolerance"), settings), "0.02") << text;
  }
  EXPECT_EQ(given_text(step_option("dt"), settings), "0.01");
  EXPECT_EQ(given_text(step_option("iterations"), settings), "1");
}

TEST(StepOptions, those_of_sor_fit_no_stepper_of_ode) {
  for (const char* name : {"law", "substeps", "tolerance", "precision", "simd", "threads"}) {
    EXPECT_TRUE(fits(step_option(name), StepperKind::sor));
    EXPECT_FALSE(fits(step_option(name), StepperKind::quick));
    EXPECT_FALSE(fits(step_option(name), StepperKind::direct));
  }
  for (const char* name : {"stepper", "dt", "iterations", "solver-seed"})
    EXPECT_TRUE(fits(step_option(name), StepperKind::quick));
}

TEST(StepOptions, files_write_names_with_underscores) {
  EXPECT_EQ(file_name(step_option("solver-seed")), "solver_seed");
  EXPECT_EQ(std::get<std::int64_t>(value_of(step_option("iterations"), {})), 1);
  EXPECT_EQ(std::get<double>(value_of(step_option("dt"), {})), 0.01);
  EXPECT_EQ(std::get<std::string>(value_of(step_option("law"), {})), "soft");
}

TEST(StepperTraits, follow_the_order_of_the_kinds) {
  EXPECT_TRUE(traits_of(StepperKind::quick).iterates);
  EXPECT_FALSE(traits_of(StepperKind::direct).iterates);
  StepperSettings sor = default_settings(StepperKind::sor, Law::ode);
  EXPECT_EQ(stepper_text(sor), "sor double");
  EXPECT_EQ(stepper_text(default_settings(StepperKind::quick)), "quick");
}

}  // namespace
}  // namespace pbmpi::stepping
