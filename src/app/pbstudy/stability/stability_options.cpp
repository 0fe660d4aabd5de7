#include "app/pbstudy/stability/stability_options.h"

#include <limits>
#include <set>

#include <fmt/core.h>

#include "app/common/step_arguments.h"
#include "core/error.h"
#include "stepping/step_options.h"

namespace pbmpi::app {
namespace {

namespace po = boost::program_options;

std::string setting_help() {
  std::string text =
      "settings, each in quotes: a stepper, then options of a step as name=value (law=ode: 1 x 20 unless "
      "others say otherwise), cut (the world in two spaces); default:";
  for (const std::string& setting : default_stability_settings()) text += " \"" + setting + "\"";
  return text;
}

po::options_description options_description() {
  po::options_description what("What to measure");
  what.add_options()  //
      ("scene", po::value<std::vector<std::string>>()->multitoken()->value_name("NAME|FILE..."),
       "scenes with a [case] (scenes/FORMAT.md); default: all of scenes/hard")                 //
      ("setting", list_of<std::string>(), setting_help().c_str())                              //
      ("dt", list_of<std::string>(), "take every setting with each of these steps, e.g. 5ms")  //
      ("most-work", po::value<double>()->value_name("N"),
       "leave out cases of more than so many bodies x steps; default: none");
  po::options_description how("How to measure");
  add_seed_option("of the scene's variation and of the solver", how);
  po::options_description all;
  all.add(what).add(how).add(what_to_write("stability.h5")).add(common_options_description());
  return all;
}

std::vector<std::string> hard_case_names() {
  std::vector<std::string> names;
  for (const scenes::SceneInfo& scene : scenes::list_scenes(scenes::SceneGroup::hard))
    names.push_back(scene.name);
  return names;
}

/// Each setting with each dt.
std::vector<StabilitySetting> crossed(const std::vector<std::string>& settings,
                                      const std::vector<std::string>& dts) {
  std::vector<StabilitySetting> all;
  std::set<std::string> names;
  for (const std::string& text : settings) {
    const StabilitySetting setting = parse_stability_setting(text);
    if (dts.empty()) all.push_back(setting);
    for (const std::string& dt : dts) {
      all.push_back(setting);
      set(stepping::step_option("dt"), dt, "--dt", all.back().stepper);
      all.back().own_dt = true;
    }
  }
  for (const StabilitySetting& one : all) {
    const std::string name = setting_text(one);
    core::require_input(names.insert(name).second,
                        "--setting, --dt: the setting " + name + " stands in the study twice; name it once");
  }
  return all;
}

}  // namespace

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

Manual stability_manual() {
  return {.name = "pbstudy stability",
          .about =
              "pbstudy stability runs scenes that are known to be hard under many settings. Each says in its "
              "file what should happen, and within which bounds; a run that keeps them passes, one beyond "
              "them is degraded or broken.",
          .usage = "mpirun -n RANKS pbstudy stability [--scene NAME...] [--setting TEXT...] [options]",
          .options = options_description(),
          .basic = {"scene", "setting", "dt", "most-work", "seed", "output", "max-time", "resume"},
          .notes = {one_case_a_rank},
          .examples = {"mpirun -n 2 pbstudy stability --setting sor quick",
                       "pbreport stability.h5 --html stability.html"}};
}

StabilityOptions parse_stability_options(const std::vector<std::string>& args) {
  const po::variables_map values = parse_command_line(args, options_description());
  StabilityOptions options;
  static_cast<StudyOptions&>(options) = study_options(values, "pbstudy stability", args);
  if (values.count("scene") == 0) options.scenes = hard_case_names();
  options.settings = crossed(list<std::string>(values, "setting", default_stability_settings()),
                             list<std::string>(values, "dt", {}));
  options.most_work = values.count("most-work") != 0 ? values["most-work"].as<double>()
                                                     : std::numeric_limits<double>::infinity();
  core::require_input(options.most_work > 0, "--most-work: it must be above 0");
  return options;
}

}  // namespace pbmpi::app
