#include "app/common/step_arguments.h"

#include <algorithm>
#include <map>
#include <sstream>

#include "core/error.h"
#include "engines/optional_engines.h"
#include "stepping/names.h"

namespace pbmpi::app {

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
