#include "app/pbstudy/study/setting_lists.h"

#include <gtest/gtest.h>

#include "core/error.h"

namespace pbmpi::app {
namespace {

using stepping::StepperKind;
using stepping::StepperSettings;

SettingList list_of_values(const char* option, std::vector<std::string> values) {
  return {&stepping::step_option(option), std::move(values)};
}

std::vector<StepperSettings> crossed(const std::vector<SettingList>& lists) {
  std::vector<StepperSettings> all;
  cross_settings({}, lists, [&](const StepperSettings& settings) { all.push_back(settings); });
  return all;
}

TEST(SettingLists, the_last_list_varies_fastest) {
  const auto all = crossed({list_of_values("substeps", {"1", "2"}), list_of_values("dt", {"0.01", "0.02"})});
  ASSERT_EQ(all.size(), 4u);
  EXPECT_EQ(all[1].substeps, 1);
  EXPECT_EQ(all[1].dt_s, 0.02);
  EXPECT_EQ(all[2].substeps, 2);
  EXPECT_EQ(all[2].dt_s, 0.01);
}

TEST(SettingLists, an_option_that_the_stepper_lacks_keeps_its_default) {
  const auto all =
      crossed({list_of_values("stepper", {"quick", "sor"}), list_of_values("substeps", {"2", "4"})});
  ASSERT_EQ(all.size(), 3u);
  EXPECT_EQ(all[0].kind, StepperKind::quick);
  EXPECT_EQ(all[0].substeps, 1);
  EXPECT_EQ(all[2].substeps, 4);
}

TEST(SettingLists, iterations_are_not_varied_where_nothing_iterates) {
  EXPECT_EQ(crossed({list_of_values("stepper", {"direct"}), list_of_values("iterations", {"1", "2"})}).size(),
            1u);
}

TEST(SettingLists, a_law_brings_its_own_sweeps_and_the_soft_one_keeps_them) {
  const auto all = crossed({list_of_values("stepper", {"sor"}), list_of_values("law", {"ode", "soft"}),
                            list_of_values("iterations", {"5", "9"})});
  ASSERT_EQ(all.size(), 3u);
  EXPECT_EQ(all[0].law, stepping::ode_law());
  EXPECT_EQ(all[0].substeps, 1);
  EXPECT_EQ(all[1].iterations, 9);
  EXPECT_EQ(all[2].law, stepping::SorLaw{});
  EXPECT_EQ(all[2].substeps, 14);
  EXPECT_EQ(all[2].iterations, 1);
}

TEST(SettingLists, refuse_a_value_that_stands_there_twice_in_whatever_unit) {
  constexpr VariedOption dt = {"dt", "", ""};
  boost::program_options::options_description description;
  add_setting_list(dt, description);
  const auto read = [&](const std::vector<std::string>& args) {
    boost::program_options::variables_map values;
    store(boost::program_options::command_line_parser(args).options(description).run(), values);
    return setting_list(dt, values).values;
  };
  EXPECT_EQ(read({"--dt", "10ms", "0.005"}), (std::vector<std::string>{"0.01", "0.005"}));
  EXPECT_THROW(read({"--dt", "10ms", "0.01"}), core::InputError);
  EXPECT_THROW(read({"--dt", "0.01", "0.01"}), core::InputError);
}

TEST(SettingLists, a_list_without_values_leaves_the_base_as_it_is) {
  const auto all = crossed({list_of_values("dt", {})});
  ASSERT_EQ(all.size(), 1u);
  EXPECT_EQ(all[0].dt_s, StepperSettings{}.dt_s);
}

}  // namespace
}  // namespace pbmpi::app
