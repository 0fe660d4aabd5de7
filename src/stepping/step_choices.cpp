#include "stepping/step_choices.h"

#include <algorithm>
#include <vector>

#include "core/error.h"
#include "core/text.h"

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

/// "--substeps, --simd and --colliders": the options that some steppers lack.
std::string options_of_some(const std::string& dashes) {
  std::vector<std::string> names;
  for (const StepOption& option : step_options()) {
    if (option.needs != nullptr) names.push_back(dashes + std::string(option.name));
  }
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i)
    text += (i == 0 ? "" : i + 1 == names.size() ? " and " : ", ") + names[i];
  return text;
}

void require_fitting(const StepperSettings& settings, const std::string& dashes) {
  core::require_input(std::ranges::all_of(step_options(),
                                          [&](const StepOption& option) {
                                            return fits(option, settings.kind) ||
                                                   is_default(option, settings);
                                          }),
                      options_of_some(dashes) + " are options of " + dashes +
                          "stepper sor; the other steppers have none of them");
}

}  // namespace

StepChoices choose_step(const std::map<std::string, std::string>& texts, const std::string& dashes) {
  require_known(texts, dashes);
  StepChoices choices;
  const auto text_of_option = [&](const StepOption& option) {
    const auto text = texts.find(std::string(option.name));
    return text == texts.end() ? std::string(option.shown_default) : text->second;
  };
  const StepOption& stepper = step_option("stepper");
  set(stepper, text_of_option(stepper), dashes + "stepper", choices.settings);
  choices.settings = default_settings(choices.settings.kind);
  for (const StepOption& option : step_options()) {
    const std::string name(option.name);
    if (!texts.contains(name) && option.shown_default.empty()) continue;
    set(option, text_of_option(option), dashes + name, choices.settings);
    choices.given.insert(name);
  }
  return choices;
}

StepperSettings settle_step(const StepChoices& choices, const StepProposal& proposal,
                            const std::string& dashes) {
  StepperSettings settings = choices.settings;
  if (!choices.has("dt")) settings.dt_s = proposal.dt_s;
  if (!choices.has("iterations"))
    settings.iterations = default_iterations(settings.kind, proposal.iterations);
  core::require_input(settings.iterations >= 1, dashes + "iterations " + std::to_string(settings.iterations) +
                                                    ": it must be at least 1");
  if (!choices.has("solver-seed")) settings.seed = proposal.seed;
  require_fitting(settings, dashes);
  return settings;
}

}  // namespace pbmpi::stepping
