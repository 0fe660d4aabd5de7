#include "app/common/step_arguments.h"

#include <algorithm>
#include <vector>

#include "core/error.h"

namespace pbmpi::app {

namespace po = boost::program_options;

namespace {

/// "--substeps, --simd and --colliders": the options that some steppers lack.
std::string options_of_some() {
  std::vector<std::string> names;
  for (const stepping::StepOption& option : stepping::step_options()) {
    if (option.needs != nullptr) names.push_back("--" + std::string(option.name));
  }
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i)
    text += (i == 0 ? "" : i + 1 == names.size() ? " and " : ", ") + names[i];
  return text;
}

}  // namespace

void add_step_option(const stepping::StepOption& option, po::options_description& description) {
  auto* value = po::value<std::string>()->value_name(std::string(option.placeholder));
  if (!option.shown_default.empty()) value->default_value(std::string(option.shown_default));
  description.add_options()(std::string(option.name).c_str(), value, std::string(option.meaning).c_str());
}

StepArguments step_arguments(const po::variables_map& values) {
  StepArguments arguments;
  const stepping::StepOption& stepper = stepping::step_option("stepper");
  set(stepper, values["stepper"].as<std::string>(), "--stepper", arguments.settings);
  arguments.settings = default_settings(arguments.settings.kind);
  for (const stepping::StepOption& option : stepping::step_options()) {
    const std::string name(option.name);
    if (values.count(name) == 0) continue;
    set(option, values[name].as<std::string>(), "--" + name, arguments.settings);
    arguments.given.insert(name);
  }
  return arguments;
}

void require_fitting(const stepping::StepperSettings& settings) {
  const auto options = stepping::step_options();
  core::require_input(std::ranges::all_of(options,
                                          [&](const stepping::StepOption& option) {
                                            return fits(option, settings.kind) ||
                                                   is_default(option, settings);
                                          }),
                      options_of_some() + " are options of --stepper sor; ODE's steppers have none of them");
}

}  // namespace pbmpi::app
