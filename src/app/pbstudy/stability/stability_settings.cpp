#include "app/pbstudy/stability/stability_settings.h"

#include <algorithm>
#include <iterator>
#include <optional>
#include <sstream>

#include "app/common/format.h"
#include "core/error.h"
#include "engines/optional_engines.h"
#include "stepping/names.h"
#include "stepping/step_options.h"

namespace pbmpi::app {
namespace {

using core::require_input;

/// One "name=value" of a setting.
void set_option(const std::string& text, const std::string& name, const std::string& value,
                StabilitySetting& setting) {
  const std::string where = "--setting '" + text + "': " + name;
  const auto option = std::ranges::find(stepping::step_options(), name, &stepping::StepOption::name);
  require_input(option != stepping::step_options().end(),
                where + ": there is no such option of a step (pbmpi --help all)");
  require_input(
      fits(*option, setting.stepper.kind),
      where + ": the stepper " + std::string(name_of(setting.stepper.kind)) + " has no such option");
  set(*option, value, where, setting.stepper);
  if (name == "law") setting.stepper = default_settings(setting.stepper.kind, setting.stepper.law.name);
  setting.own_dt = setting.own_dt || name == "dt";
}

}  // namespace

StabilitySetting parse_stability_setting(const std::string& text) {
  std::istringstream stream(text);
  std::string word;
  StabilitySetting setting;
  require_input(static_cast<bool>(stream >> word),
                "--setting: it begins with a stepper, e.g. \"sor iterations=80\"");
  set(stepping::step_option("stepper"), word, "--setting '" + text + "': stepper", setting.stepper);
  engines::require_in_build(setting.stepper.kind, "--setting '" + text + "'");
  setting.stepper = default_settings(setting.stepper.kind);
  std::vector<std::string> words{std::istream_iterator<std::string>(stream), {}};
  // A law brings its own iterations and substeps, so that it comes before them.
  std::stable_partition(words.begin(), words.end(),
                        [](const std::string& one) { return one.starts_with("law="); });
  for (const std::string& one : words) {
    const std::size_t equals = one.find('=');
    if (one == "cut") {
      setting.cut = true;
      continue;
    }
    require_input(equals != std::string::npos,
                  "--setting '" + text + "': " + one + ": write name=value, or cut");
    set_option(text, one.substr(0, equals), one.substr(equals + 1), setting);
  }
  require_input(!setting.cut || traits_of(setting.stepper.kind).cuts_spaces,
                "--setting '" + text + "': this stepper steps whole worlds; leave out cut");
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
  if (setting.own_dt) text += format(", dt %g s", setting.stepper.dt_s);
  if (setting.cut) text += ", in two spaces";
  return text;
}

}  // namespace pbmpi::app
