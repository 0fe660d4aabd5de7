#include "app/common/step_arguments.h"

#include <algorithm>
#include <map>
#include <set>
#include <sstream>

#include "core/error.h"
#include "engines/optional_engines.h"
#include "engines/stepper_factory.h"
#include "estimate/short_run.h"
#include "stepping/names.h"

namespace pbmpi::app {

using stepping::StepperSettings;

StepperSettings default_estimate(const StepperSettings& precise) {
  // Forces that a crash's last substep ended with act for a whole substep of the estimate: six times as long,
  // not for a whole step.
  constexpr int substeps_in_one = 6;
  StepperSettings estimate = precise;
  estimate.iterations = 1;
  for (int* substeps : {&estimate.substeps, &estimate.law.most_substeps})
    *substeps = std::max(1, *substeps / substeps_in_one);
  estimate.law.newton = false;  // it takes far longer than the sweeps
  estimate.residuals = false;
  estimate.contacts = false;
  estimate.profile = false;
  return estimate;
}

StepperSettings estimate_settings(const std::string& setting, const StepperSettings& precise) {
  const std::string where = "--feec='" + setting + "'";
  const SettingWords words = setting_words(setting);
  StepperSettings estimate = default_estimate(precise);
  set_stepper(words, where, estimate);
  if (!traits_of(estimate.kind).has_precision) estimate.precision = stepping::Precision::double_;
  core::require_input(words.flags.empty(), where +
                                               ": write it as STEPPER iterations=N precision=NAME, each "
                                               "of which may be left out");
  std::set<std::string> seen;
  for (const auto& [name, value] : words.options) {
    core::require_input(seen.insert(name).second, where + ": " + name + " stands there twice");
    core::require_input(name == "iterations" || name == "precision",
                        where + ": " + name +
                            ": an estimate has a stepper, iterations and a precision of its own; all else is "
                            "as in the precise run");
    set_by_name(name, value, where, estimate);
  }
  return estimate;
}

std::string estimate_text(const StepperSettings& estimate) {
  std::string text(name_of(estimate.kind));
  for (const std::string_view name : {"iterations", "precision"}) {
    const stepping::StepOption& option = stepping::step_option(name);
    if (acts(option, estimate.kind)) text += " " + std::string(name) + "=" + text_of(option, estimate);
  }
  return text;
}

std::unique_ptr<stepping::Estimator> make_estimator(const StepperSettings& settings) {
  return std::make_unique<estimate::ShortRun>(engines::make_stepper(settings, "estimate: "));
}

namespace po = boost::program_options;

void add_step_option(const stepping::StepOption& option, po::options_description& description) {
  auto* value = po::value<std::string>()->value_name(std::string(option.placeholder));
  if (!option.shown_default.empty()) value->default_value(std::string(option.shown_default));
  description.add_options()(std::string(option.name).c_str(), value, std::string(option.meaning).c_str());
}

stepping::StepChoices step_arguments(const po::variables_map& values) {
  std::map<std::string, std::string> texts;
  for (const stepping::StepOption& option : stepping::step_options()) {
    const std::string name(option.name);
    if (values.count(name) != 0) texts[name] = values[name].as<std::string>();
  }
  return stepping::choose_step(texts, "--");
}

SettingWords setting_words(const std::string& text) {
  SettingWords words;
  std::istringstream stream(text);
  bool is_first = true;
  for (std::string word; stream >> word; is_first = false) {
    const std::size_t equals = word.find('=');
    if (equals != std::string::npos)
      words.options.emplace_back(word.substr(0, equals), word.substr(equals + 1));
    else if (is_first)
      words.stepper = word;
    else
      words.flags.push_back(word);
  }
  std::stable_partition(words.options.begin(), words.options.end(),
                        [](const auto& option) { return option.first == "law"; });
  return words;
}

void set_stepper(const SettingWords& words, const std::string& where, stepping::StepperSettings& settings) {
  if (words.stepper.empty()) return;
  set(stepping::step_option("stepper"), words.stepper, where + ": stepper", settings);
  engines::require_in_build(settings.kind, where);
}

void set_by_name(const std::string& name, const std::string& value, const std::string& where,
                 stepping::StepperSettings& settings) {
  const auto option = std::ranges::find(stepping::step_options(), name, &stepping::StepOption::name);
  core::require_input(option != stepping::step_options().end(),
                      where + ": " + name + ": there is no such option of a step (pbmpi --help all)");
  core::require_input(
      acts(*option, settings.kind),
      where + ": " + name + ": the stepper " + std::string(name_of(settings.kind)) + " has no such option");
  set(*option, value, where + ": " + name, settings);
}

}  // namespace pbmpi::app
