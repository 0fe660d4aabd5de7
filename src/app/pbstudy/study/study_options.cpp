#include "app/pbstudy/study/study_options.h"

#include <set>

#include "core/quantity.h"
#include "core/system/input_file.h"

namespace pbmpi::app {

namespace po = boost::program_options;

namespace {

/// The arguments without those that only say where, how long and how loudly.
std::vector<std::string> deciding_among(const std::vector<std::string>& args) {
  const std::set<std::string, std::less<>> switches = {"--resume", "--quiet", "-q"};
  const std::set<std::string, std::less<>> valued = {"--output", "-o", "--max-time", "--progress"};
  std::vector<std::string> deciding;
  for (std::size_t i = 0; i < args.size(); ++i) {
    const std::string name = args[i].substr(0, args[i].find('='));
    if (valued.contains(name)) {
      if (name == args[i]) ++i;
    } else if (!switches.contains(name)) {
      deciding.push_back(args[i]);
    }
  }
  return deciding;
}

}  // namespace

void require_at_least(const std::vector<int>& given, int least, const char* option) {
  for (const int value : given) {
    core::require_input(value >= least, std::string(option) + " " + std::to_string(value) +
                                            ": it must be at least " + std::to_string(least));
  }
}

std::optional<int> given(const boost::program_options::variables_map& values, const char* name, int least) {
  if (values.count(name) == 0) return std::nullopt;
  const int value = values[name].as<int>();
  require_at_least({value}, least, ("--" + std::string(name)).c_str());
  return value;
}

void add_scene_option(po::options_description& what) {
  what.add_options()("scene", po::value<std::vector<std::string>>()->multitoken()->value_name("NAME|FILE..."),
                     "scenes that pbmpi brings, or files (.toml, .xml, .urdf), or all; default: all nine");
}

po::options_description how_to_measure(const HowOptions& says) {
  po::options_description how("How to measure");
  how.add_options()                                                                                      //
      ("replicas", po::value<int>()->value_name("N"), "worlds of a case; default: the scene's")          //
      ("frames", po::value<int>()->value_name("N"), "measured frames; default: the scene's")             //
      ("warmup", po::value<int>()->value_name("N"), "frames before them; default: the scene's")          //
      ("repeats", po::value<int>()->default_value(says.default_repeats)->value_name("N"), says.repeats)  //
      ("floor-seeds", po::value<int>()->default_value(says.default_floor_seeds)->value_name("N"),        //
       says.floor_seeds);
  add_seed_option(says.seed, how);
  return how;
}

po::options_description what_to_write(const char* default_output) {
  po::options_description write("What to write");
  write.add_options()                                                                                      //
      ("output,o", po::value<std::string>()->default_value(default_output)->value_name("FILE"),            //
       "HDF5 file of the study (io/SCHEMA.md); cases that are done are kept beside it until it is there")  //
      ("max-time", po::value<std::string>()->value_name("TIME"),
       "begin no case after so long, e.g. 90s, 30min, 2h; exit code 75 if any is left, as after a signal "
       "USR2")  //
      ("resume", po::bool_switch(),
       "leave out the cases that a stopped or killed study of the same options and build has done");
  return write;
}

StudyOptions study_options(const po::variables_map& values, const std::string& program,
                           const std::vector<std::string>& args) {
  StudyOptions options;
  options.common = common_options(values);
  options.command_line = program;
  for (const std::string& arg : args) options.command_line += " " + arg;
  options.scenes = study_scene_names(list<std::string>(values, "scene", {}));
  options.overrides = {given(values, "replicas", 1), given(values, "frames", 1), given(values, "warmup", 0)};
  options.repeats = given(values, "repeats", 1).value_or(1);
  options.floor_seeds = given(values, "floor-seeds", 1).value_or(0);
  options.seed = given_seed(values);
  options.output = output_path(values, "output").value();
  options.resume = values["resume"].as<bool>();
  if (values.count("max-time") != 0)
    options.max_time_s =
        core::read_quantity(values["max-time"].as<std::string>(), "--max-time", core::run_time);
  options.deciding = deciding_among(args);
  if (values.count("config") != 0)
    options.deciding.push_back(core::read_input_file(values["config"].as<std::string>(), "see --config"));
  return options;
}

}  // namespace pbmpi::app
