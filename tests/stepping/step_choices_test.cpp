#include "stepping/step_choices.h"

#include <gtest/gtest.h>

#include <string>

#include "core/error.h"

namespace pbmpi::stepping {
namespace {

std::string refusal(const std::map<std::string, std::string>& texts, const std::string& dashes = "") {
  try {
    settle_step(choose_step(texts, dashes), {}, dashes);
  } catch (const core::InputError& error) {
    return error.what();
  }
  return "";
}

TEST(StepChoices, leave_open_what_the_scene_and_the_run_fill_in) {
  const StepProposal proposal{.dt_s = 0.02, .iterations = 33, .seed = 7};
  const StepperSettings quick = settle_step(choose_step({{"stepper", "quick"}}, ""), proposal, "");
  EXPECT_EQ(quick.dt_s, 0.02);
  EXPECT_EQ(quick.iterations, 33);
  EXPECT_EQ(quick.seed, 7u);
  const StepperSettings sor = settle_step(choose_step({}, ""), proposal, "");
  EXPECT_EQ(sor.kind, StepperKind::sor) << "as --help says";
  EXPECT_EQ(sor.iterations, 1) << "those of the scene are quick's";
  EXPECT_EQ(sor.substeps, default_settings(StepperKind::sor).substeps);
}

TEST(StepChoices, win_over_what_is_proposed) {
  const StepChoices choices = choose_step({{"dt", "0.005"}, {"iterations", "4"}, {"solver-seed", "9"}}, "");
  EXPECT_TRUE(choices.has("dt"));
  EXPECT_FALSE(choices.has("substeps"));
  const StepperSettings settings = settle_step(choices, {.dt_s = 0.02, .iterations = 33, .seed = 7}, "");
  EXPECT_EQ(settings.dt_s, 0.005);
  EXPECT_EQ(settings.iterations, 4);
  EXPECT_EQ(settings.seed, 9u);
}

TEST(StepChoices, of_a_law_bring_its_substeps_and_iterations_unless_others_are_chosen) {
  const auto chosen = [](const std::map<std::string, std::string>& texts) {
    return settle_step(choose_step(texts, ""), {.iterations = 33}, "");
  };
  const StepperSettings ode = chosen({{"law", "ode"}});
  EXPECT_EQ(ode.law, ode_law());
  EXPECT_EQ(ode.substeps, 1);
  EXPECT_EQ(ode.iterations, 33) << "those of the scene, as with quick";
  EXPECT_EQ(chosen({{"law", "ode"}, {"iterations", "80"}, {"substeps", "2"}}).iterations, 80);
  EXPECT_EQ(chosen({{"law", "ode"}, {"iterations", "80"}, {"substeps", "2"}}).substeps, 2);
  const StepperSettings coulomb = chosen({{"law", "coulomb"}});
  EXPECT_EQ(coulomb.law, coulomb_law());
  EXPECT_EQ(coulomb.substeps, 1);
  EXPECT_EQ(coulomb.iterations, 33);
  EXPECT_EQ(chosen({{"law", "soft"}}).substeps, 14);
  EXPECT_EQ(chosen({{"stepper", "quick"}}).law, ode_law());
}

TEST(StepChoices, that_cannot_be_are_refused_by_name) {
  EXPECT_NE(refusal({{"substep", "3"}}).find("substep: a step has no such option; did you mean 'substeps'"),
            std::string::npos)
      << refusal({{"substep", "3"}});
  EXPECT_EQ(refusal({{"substeps", "0"}}, "--").find("--substeps"), 0u);
  EXPECT_EQ(refusal({{"stepper", "quick"}, {"substeps", "4"}}, "--"),
            "--substeps is an option of --stepper sor; --stepper quick does not have it: leave it out");
}

}  // namespace
}  // namespace pbmpi::stepping
