#include "app/pbstudy/study/study_options.h"

#include "app/pbstudy/study/option_lists.h"

namespace pbmpi::app {

namespace po = boost::program_options;

void add_scene_option(po::options_description& what) {
  what.add_options()("scene",
                     po::value<std::vector<std::string>>()->multitoken()->value_name("NAME|FILE.toml..."),
                     "scenes, or all; default: all nine");
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
  write.add_options()("output,o", po::value<std::string>()->default_value(default_output)->value_name("FILE"),
                      "HDF5 file of the study (io/SCHEMA.md)");
  return write;
}

StudyOptions study_options(const po::variables_map& values, const std::string& program,
                           const std::vector<std::string>& args) {
  StudyOptions options;
  options.help = values.count("help") != 0;
  options.common = common_options(values);
  options.command_line = program;
  for (const std::string& arg : args) options.command_line += " " + arg;
  options.scenes = study_scene_names(list<std::string>(values, "scene", {}));
  options.overrides = {given(values, "replicas", 1), given(values, "frames", 1), given(values, "warmup", 0)};
  options.repeats = given(values, "repeats", 1).value_or(1);
  options.floor_seeds = given(values, "floor-seeds", 1).value_or(0);
  options.seed = given_seed(values);
  options.output = output_path(values, "output").value();
  return options;
}

}  // namespace pbmpi::app
