#include "app/pbstudy/study/setting_lists.h"

#include <sstream>

#include "app/pbstudy/study/study_options.h"
#include "engines/optional_engines.h"

namespace pbmpi::app {
namespace {

std::vector<std::string> words(std::string_view text) {
  std::vector<std::string> all;
  std::istringstream stream{std::string(text)};
  for (std::string word; stream >> word;) all.push_back(word);
  return all;
}

/// A stepper and a law have their own sweeps and substeps.
void set_value(const SettingList& list, const std::string& value, stepping::StepperSettings& settings) {
  const std::string name(list.option->name);
  set(*list.option, value, "--" + name, settings);
  if (name == "stepper" || name == "law") settings = usual_settings(settings, settings.law.name);
}

bool is_soft(const stepping::StepperSettings& settings) { return settings.law.name == stepping::Law::soft; }

/// The values that make a difference over `base`; none: `base` is left as it is.
std::span<const std::string> useful(const SettingList& list, const stepping::StepperSettings& base) {
  const std::span<const std::string> values = list.values;
  if (!fits(*list.option, base.kind)) return {};
  if (list.option->name == "iterations" && !traits_of(base.kind).iterates) return values.first(1);
  if (list.option->name == "iterations" && is_soft(base)) return {};
  if (list.option->name == "approach" && !is_soft(base)) return {};
  if (list.option->name == "tolerance" && (!is_soft(base) || base.substeps == 1)) return {};
  return values;
}

}  // namespace

stepping::StepperSettings usual_settings(const stepping::StepperSettings& settings, stepping::Law law) {
  stepping::StepperSettings usual = default_settings(settings.kind, law);
  usual.dt_s = settings.dt_s;
  usual.seed = settings.seed;
  return usual;
}

void add_setting_list(const VariedOption& varied, boost::program_options::options_description& description) {
  description.add_options()(std::string(varied.name).c_str(), list_of<std::string>(),
                            std::string(varied.meaning).c_str());
}

SettingList setting_list(const VariedOption& varied, const boost::program_options::variables_map& values) {
  SettingList given = {&stepping::step_option(varied.name),
                       list<std::string>(values, std::string(varied.name).c_str(), words(varied.fallback))};
  stepping::StepperSettings tried;
  for (std::string& value : given.values) {
    set_value(given, value, tried);
    if (varied.name == "stepper") engines::require_in_build(tried.kind, "--stepper " + value);
    value = given_text(*given.option, tried);
  }
  require_distinct(given.values, "--" + std::string(varied.name));
  return given;
}

std::vector<SettingList> setting_lists(std::span<const VariedOption> varied,
                                       const boost::program_options::variables_map& values) {
  std::vector<SettingList> lists;
  for (const VariedOption& one : varied) lists.push_back(setting_list(one, values));
  return lists;
}

void cross_settings(const stepping::StepperSettings& base, std::span<const SettingList> lists,
                    const std::function<void(const stepping::StepperSettings&)>& take) {
  if (lists.empty()) return take(base);
  const std::span<const std::string> values = useful(lists.front(), base);
  if (values.empty()) return cross_settings(base, lists.subspan(1), take);
  for (const std::string& value : values) {
    stepping::StepperSettings settings = base;
    set_value(lists.front(), value, settings);
    cross_settings(settings, lists.subspan(1), take);
  }
}

}  // namespace pbmpi::app
