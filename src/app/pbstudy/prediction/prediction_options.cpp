#include "app/pbstudy/prediction/prediction_options.h"

#include <cmath>

#include "core/error.h"
#include "core/quantity.h"

namespace pbmpi::app {
namespace {

namespace po = boost::program_options;

po::options_description options_description() {
  po::options_description what("What to measure");
  add_scene_option(what);
  what.add_options()  //
      ("threshold", list_of<double>(),
       "thresholds of fuzzy prediction; the first is that of Figure 8; default: 1e-6 1e-8 1e-10 1e-12")  //
      ("detail-scene", po::value<std::string>()->default_value("CrashSk")->value_name("NAME|none"),
       "the scene of the sensitivity table and of collision and forward step alone, if it is among the "
       "scenes")  //
      ("full",
       "all worlds of 100CrSk (default: 10 of 100), and cycles of all thresholds, of sor and of quick in "
       "single precision");
  po::options_description how("How to measure");
  how.add_options()  //
      ("replicas", po::value<int>()->value_name("N"),
       "worlds of a case; default: the scene's, at most 10")                                  //
      ("frames", po::value<int>()->value_name("N"), "measured frames; default: the scene's")  //
      ("warmup", po::value<int>()->value_name("N"),
       "frames before them, without cycles; default: the scene's")  //
      ("budget", po::value<std::string>()->value_name("TIME"),
       "the time that a frame may take, e.g. 3.33ms; default: a tenth of 1/30 s")                           //
      ("tool-option", list_of<std::string>(), "options for pbvalue, e.g. --tool-option=--table-entries=0")  //
      ("time-limit", po::value<std::string>()->default_value("30min")->value_name("TIME"),
       "a run that takes longer has not ended");
  add_seed_option("of the scene's variation and of the solver", how);
  po::options_description all;
  all.add(what).add(how).add(what_to_write("prediction.h5")).add(common_options_description());
  return all;
}

}  // namespace

Manual prediction_manual() {
  return {
      .name = "pbstudy prediction",
      .about =
          "pbstudy prediction runs pbmpi under the Valgrind tool pbvalue (docs/prediction.md): the results "
          "of instructions are predicted, exactly (EVP) and within a threshold (FVP), and those that are "
          "near go on into the simulation. It counts hits, instructions and the cycles of the paper's "
          "processor, and compares the result with the unpredicted run.",
      .usage = "mpirun -n RANKS pbstudy prediction [--scene NAME...] [options]",
      .options = options_description(),
      .basic = {"scene", "threshold", "full", "replicas", "frames", "budget", "time-limit", "output",
                "max-time", "resume"},
      .notes = {one_case_a_rank},
      .examples = {"mpirun -n 2 pbstudy prediction --scene CrashSk",
                   "jobs/paper/paper.py prediction prediction.h5 --html prediction.html"}};
}

PredictionOptions parse_prediction_options(const std::vector<std::string>& args) {
  const po::variables_map values = parse_command_line(args, options_description());
  PredictionOptions options;
  static_cast<StudyOptions&>(options) = study_options(values, "pbstudy prediction", args);
  options.thresholds = list<double>(values, "threshold", {1e-6, 1e-8, 1e-10, 1e-12});
  for (const double threshold : options.thresholds)
    core::require_input(threshold > 0 && std::isfinite(threshold), "--threshold: it must be above 0");
  options.detail_scene = values["detail-scene"].as<std::string>();
  options.tool_options = list<std::string>(values, "tool-option", {});
  if (values.count("budget") != 0)
    options.budget_s = core::read_quantity(values["budget"].as<std::string>(), "--budget", core::frame_time);
  options.time_limit_s =
      core::read_quantity(values["time-limit"].as<std::string>(), "--time-limit", core::run_time);
  options.full = values.count("full") != 0;
  return options;
}

}  // namespace pbmpi::app
