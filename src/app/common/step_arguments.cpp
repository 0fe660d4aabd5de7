#include "app/common/step_arguments.h"

#include <map>
#include <string>

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

}  // namespace pbmpi::app
