#include "app/pbstudy/stability/stability_settings.h"

#include <fmt/core.h>

#include "app/common/step_arguments.h"
#include "core/error.h"
#include "stepping/step_options.h"

namespace pbmpi::app {

using core::require_input;

StabilitySetting parse_stability_setting(const std::string& text) {
  const std::string where = "--setting '" + text + "'";
  const SettingWords words = setting_words(text);
  require_input(!words.stepper.empty(), where + ": it begins with a stepper, e.g. \"sor iterations=80\"");
  StabilitySetting setting;
  set_stepper(words, where, setting.stepper);
  setting.stepper = default_settings(setting.stepper.kind);
  for (const auto& [name, value] : words.options) {
    set_by_name(name, value, where, setting.stepper);
    if (name == "law") setting.stepper = default_settings(setting.stepper.kind, setting.stepper.law.name);
    setting.own_dt = setting.own_dt || name == "dt";
  }
  for (const std::string& flag : words.flags)
    require_input(flag == "cut", where + ": " + flag + ": write name=value, or cut");
  setting.cut = !words.flags.empty();
  require_input(!setting.cut || traits_of(setting.stepper.kind).cuts_spaces,
                where + ": this stepper steps whole worlds; leave out cut");
  return setting;
}

const std::vector<std::string>& default_stability_settings() {
  static const std::vector<std::string> settings = {
      "quick",
      "direct",
      "sor",
      "sor precision=single",
      "sor substeps=8",
      "sor law=ode",
      "sor law=ode iterations=80",
      "sor cut",
  };
  return settings;
}

std::string setting_text(const StabilitySetting& setting) {
  std::string text = stepping::setting_text(setting.stepper);
  if (setting.own_dt) text += fmt::format(", dt {:g} s", setting.stepper.dt_s);
  if (setting.cut) text += ", in two spaces";
  return text;
}

}  // namespace pbmpi::app
