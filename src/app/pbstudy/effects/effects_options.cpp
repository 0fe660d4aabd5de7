#include "app/pbstudy/effects/effects_options.h"

#include <algorithm>
#include <array>

#include "core/error.h"
#include "effects/effect_choices.h"
#include "effects/effects.h"

namespace pbmpi::app {
namespace {

namespace po = boost::program_options;

/// In the order in which cases are crossed, the last varying fastest.
constexpr std::array<VariedOption, 2> varied = {{
    {"stepper", "quick, direct, sor, bullet, mujoco; default: quick sor", "quick sor"},
    {"precision", "sor: double, single; default: double", "double"},
}};

po::options_description options_description() {
  po::options_description what("What to measure (lists, separated by blanks)");
  add_scene_option(what);
  what.add_options()("effect", list_of<std::string>(), "effects; default: all (pbmpi --describe)");
  for (const VariedOption& one : varied) add_setting_list(one, what);
  what.add_options()("iterations", po::value<int>()->value_name("N"),
                     "default: the scene's with quick, 1 with sor");
  const po::options_description how =
      how_to_measure({"of the scene's variation and of the solver",
                      "how often each frame is timed with and without the effect, in turn", 15,
                      "noise floor: the scene as it is with this many other solver seeds", 4});
  po::options_description all;
  all.add(what).add(how).add(what_to_write("effects.h5")).add(common_options_description());
  return all;
}

/// The names given, each once and in the registry's order; all names if none is given.
std::vector<std::string> known_effects(const std::vector<std::string>& given) {
  for (const std::string& name : given) effects::require_effect(name);
  std::vector<std::string> names;
  for (const effects::Effect& effect : effects::effect_registry()) {
    if (given.empty() || std::find(given.begin(), given.end(), effect.name) != given.end())
      names.emplace_back(effect.name);
  }
  return names;
}

}  // namespace

Manual effects_manual() {
  return {
      .name = "pbstudy effects",
      .about =
          "pbstudy effects measures what each effect costs. Each case is a scene (with its replicas), a "
          "stepper and an effect. From the scene's own state at the start of each measured frame the "
          "frame is done with and without the effect, in turn, so that both meet the same contacts. An "
          "effect that the scene calls for is left out: what that saves, and how far the result is then "
          "from the scene's own. One that nothing calls for is demanded: what that costs, and that no "
          "bit changes.",
      .usage = "mpirun -n RANKS pbstudy effects [--scene NAME...] [options]",
      .options = options_description(),
      .basic = {"scene", "effect", "stepper", "precision", "replicas", "frames", "repeats", "floor-seeds",
                "output", "max-time", "resume"},
      .notes = {std::string(one_case_a_rank) + spoils_times +
                " Instructions are counted by the processor's counter where Linux gives it "
                "(perf_event_open), or under callgrind (jobs/effects.sh --instructions); else they are not "
                "in the file, and pbreport effects --instructions-from takes those of another."},
      .examples = {"mpirun -n 2 pbstudy effects --scene CrashWa", "pbreport effects.h5 --html effects.html"}};
}

EffectsOptions parse_effects_options(const std::vector<std::string>& args) {
  const po::variables_map values = parse_command_line(args, options_description());
  EffectsOptions options;
  static_cast<StudyOptions&>(options) = study_options(values, "pbstudy effects", args);
  options.effects = known_effects(list<std::string>(values, "effect", {}));
  options.settings = setting_lists(varied, values);
  options.iterations = given(values, "iterations", 1);
  return options;
}

}  // namespace pbmpi::app
