#include "stepping/step_choices.h"

#include <algorithm>
#include <vector>

#include "core/error.h"
#include "core/text.h"
#include "stepping/names.h"

namespace pbmpi::stepping {
namespace {

void require_known(const std::map<std::string, std::string>& texts, const std::string& dashes) {
  std::vector<std::string> names;
  for (const StepOption& option : step_options()) names.emplace_back(option.name);
  for (const auto& [name, text] : texts) {
    if (std::find(names.begin(), names.end(), name) == names.end())
      throw core::InputError(dashes + name + ": a step has no such option" + core::suggestion(name, names));
  }
}

/// Makes a list such as "sor, quick and bullet".
std::string listed(const std::vector<std::string>& names) {
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i)
    text += (i == 0 ? "" : i + 1 == names.size() ? " and " : ", ") + names[i];
  return text;
}

std::vector<StepperKind> steppers_with(const StepOption& option) {
  std::vector<StepperKind> kinds;
  for (std::size_t i = 0; i < stepper_traits.size(); ++i) {
    if (fits(option, static_cast<StepperKind>(i))) kinds.push_back(static_cast<StepperKind>(i));
  }
  return kinds;
}

std::string refusal(const StepOption& option, StepperKind kind, const std::string& dashes) {
  std::vector<std::string> steppers;
  for (const StepperKind one : steppers_with(option)) steppers.emplace_back(name_of(one));
  return dashes + std::string(option.name) + " is an option of " + dashes + "stepper " + listed(steppers) +
         "; " + dashes + "stepper " + std::string(name_of(kind)) + " does not have it: leave it out";
}

void require_fitting(const StepperSettings& settings, const std::string& dashes) {
  for (const StepOption& option : step_options()) {
    if (!fits(option, settings.kind) && !is_default(option, settings))
      throw core::InputError(refusal(option, settings.kind, dashes));
  }
}

}  // namespace

StepChoices choose_step(const std::map<std::string, std::string>& texts, const std::string& dashes) {
  require_known(texts, dashes);
  StepChoices choices;
  const auto choose = [&](const StepOption& option) {
    const std::string name(option.name);
    const auto text = texts.find(name);
    if (text == texts.end() && option.shown_default.empty()) return;
    set(option, text == texts.end() ? option.shown_default : text->second, dashes + name, choices.settings);
    choices.given.insert(name);
  };
  choose(step_option("stepper"));
  choose(step_option("law"));
  choices.settings = default_settings(choices.settings.kind, choices.settings.law.name);
  for (const StepOption& option : step_options()) choose(option);
  return choices;
}

StepperSettings settle_step(const StepChoices& choices, const StepProposal& proposal,
                            const std::string& dashes) {
  StepperSettings settings = choices.settings;
  if (!choices.has("dt")) settings.dt_s = proposal.dt_s;
  if (!choices.has("iterations"))
    settings.iterations = default_iterations(settings.kind, settings.law.name, proposal.iterations);
  core::require_input(settings.iterations >= 1, dashes + "iterations " + std::to_string(settings.iterations) +
                                                    ": it must be at least 1");
  if (!choices.has("solver-seed")) settings.seed = proposal.seed;
  require_fitting(settings, dashes);
  return settings;
}

}  // namespace pbmpi::stepping
