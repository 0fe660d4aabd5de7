#include "app/pbstudy/study/table_columns.h"

#include <gtest/gtest.h>

#include "stepping/names.h"

namespace pbmpi::app {
namespace {

using stepping::StepperKind;

struct AnyCase {
  stepping::StepperSettings stepper;
};

const std::vector<AnyCase> cases = {{default_settings(StepperKind::sor)},
                                    {default_settings(StepperKind::quick)}};

std::vector<std::string> texts(const std::string& name, std::vector<io::TableColumn> columns = {}) {
  add_step_columns(cases, columns);
  const auto found =
      std::ranges::find_if(columns, [&](const io::TableColumn& one) { return one.name == name; });
  return std::get<std::vector<std::string>>(found->values);
}

TEST(TableColumns, a_setting_is_there_in_short_unless_the_study_words_it_itself) {
  EXPECT_EQ(texts("setting"), (std::vector{setting_text(cases[0].stepper), setting_text(cases[1].stepper)}));
  const std::vector<std::string> own = {"sor, in two spaces", "quick"};
  EXPECT_EQ(texts("setting", {{"setting", "", own}}), own);
}

TEST(TableColumns, options_are_the_words_that_give_the_setting) {
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const std::string text = " " + texts("options")[i] + " ";
    EXPECT_EQ(text.find(" --stepper " + std::string(name_of(cases[i].stepper.kind)) + " "), 0u) << text;
    for (const stepping::StepOption& option : stepping::step_options()) {
      const bool is_there = text.find(" --" + std::string(option.name) + " " +
                                      given_text(option, cases[i].stepper) + " ") != std::string::npos;
      EXPECT_EQ(is_there, option.in_studies && fits(option, cases[i].stepper.kind)) << option.name << text;
    }
  }
}

}  // namespace
}  // namespace pbmpi::app
