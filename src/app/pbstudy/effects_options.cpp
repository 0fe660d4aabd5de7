#include "app/pbstudy/effects_options.h"

#include <algorithm>
#include <sstream>

#include "app/pbstudy/option_lists.h"
#include "core/error.h"
#include "model/effects.h"

namespace pbmpi::app {
namespace {

namespace po = boost::program_options;

po::options_description options_description() {
  po::options_description what("What to measure (lists, separated by blanks)");
  what.add_options()  //
      ("scene", po::value<std::vector<std::string>>()->multitoken()->value_name("NAME|FILE.toml..."),
       "scenes, or all; default: all nine")                                           //
      ("effect", list_of<std::string>(), "effects; default: all (pbmpi --describe)")  //
      ("stepper", list_of<std::string>(), "quick, direct, sor; default: quick sor")   //
      ("precision", list_of<std::string>(), "sor: double, single; default: double")   //
      ("iterations", po::value<int>()->value_name("N"), "default: the scene's");
  po::options_description how("How to measure");
  how.add_options()                                                                              //
      ("replicas", po::value<int>()->value_name("N"), "worlds of a case; default: the scene's")  //
      ("frames", po::value<int>()->value_name("N"), "measured frames; default: the scene's")     //
      ("warmup", po::value<int>()->value_name("N"), "frames before them; default: the scene's")  //
      ("seed", po::value<std::uint64_t>()->default_value(1)->value_name("N"),
       "of the scene's variation and of the solver")  //
      ("repeats", po::value<int>()->default_value(15)->value_name("N"),
       "how often each frame is timed with and without the effect, in turn")  //
      ("floor-seeds", po::value<int>()->default_value(4)->value_name("N"),
       "noise floor: the scene as it is with this many other solver seeds")  //
      ("instructions-from", po::value<std::string>()->value_name("FILE"),
       "take the counts of instructions from this study of the same cases, which counted them");
  po::options_description write("What to write");
  write.add_options()("output,o", po::value<std::string>()->default_value("effects.h5")->value_name("FILE"),
                      "HDF5 file of the study (io/SCHEMA.md)");
  po::options_description all;
  all.add(what).add(how).add(write).add(common_options_description());
  return all;
}

/// The names given, each once and in the registry's order; all for none.
std::vector<std::string> known_effects(const std::vector<std::string>& given) {
  for (const std::string& name : given) model::require_effect(name);
  std::vector<std::string> names;
  for (const model::Effect& effect : model::effect_registry()) {
    if (given.empty() || std::find(given.begin(), given.end(), effect.name) != given.end())
      names.emplace_back(effect.name);
  }
  return names;
}

}  // namespace

std::string effects_help_text() {
  std::ostringstream text;
  text << "pbstudy effects measures what each effect costs. Each case is a scene (with its replicas), a "
          "stepper and an effect. From the scene's own state at the start of each measured frame the frame "
          "is "
          "done with and without the effect, in turn, so that both meet the same contacts. An effect that "
          "the "
          "scene calls for is left out: what that saves, and how far the result is then from the scene's "
          "own. "
          "One that nothing calls for is demanded: what that costs, and that no bit changes.\n\n"
       << "Usage: mpirun -n RANKS pbstudy effects [--scene NAME...] [options]\n\n"
       << options_description()
       << "\nThe cases are dealt out over the ranks; a rank works on one at a time. More ranks than cores "
          "spoil the times.\nInstructions are counted by the processor's counter where Linux gives it "
          "(perf_event_open), or under\ncallgrind (jobs/effects.sh --instructions); else they are not in "
          "the file.\nThen: pbreport effects.h5 --html effects.html\n";
  return text.str();
}

EffectsOptions parse_effects_options(const std::vector<std::string>& args) {
  const po::variables_map values = parse_command_line(args, options_description());
  EffectsOptions options;
  options.help = values.count("help") != 0;
  options.common = common_options(values);
  options.command_line = "pbstudy effects";
  for (const std::string& arg : args) options.command_line += " " + arg;
  options.scenes = study_scene_names(list<std::string>(values, "scene", {}));
  options.effects = known_effects(list<std::string>(values, "effect", {}));
  options.steppers =
      choices<model::StepperKind>(values, "stepper", model::stepper_kind_names, {"quick", "sor"});
  options.precisions = choices<model::Precision>(values, "precision", model::precision_names, {"double"});
  options.iterations = given(values, "iterations", 1);
  options.overrides = {given(values, "replicas", 1), given(values, "frames", 1), given(values, "warmup", 0)};
  options.repeats = given(values, "repeats", 1).value();
  options.floor_seeds = given(values, "floor-seeds", 1).value();
  options.seed = values["seed"].as<std::uint64_t>();
  options.instructions_from = output_path(values, "instructions-from");
  options.output = values["output"].as<std::string>();
  core::require_input(options.instructions_from != options.output,
                      "--instructions-from " + options.output + ": it is to be read, not written over");
  return options;
}

}  // namespace pbmpi::app
