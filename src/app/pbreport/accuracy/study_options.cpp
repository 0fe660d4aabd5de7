#include "app/pbreport/accuracy/study_options.h"

#include <array>

#include "app/common/options.h"
#include "app/common/quantities.h"
#include "core/error.h"
#include "model/names.h"

namespace pbmpi::app {
namespace {

namespace po = boost::program_options;
using core::require_input;

constexpr std::array<std::string_view, 4> measure_names = {"rms", "p99", "max", "joint"};

po::options_description visible_options() {
  po::options_description choose("What to choose");
  choose.add_options()  //
      ("budget", po::value<std::string>()->value_name("TIME"),
       "name, per scene, the setting with the least defect that fits this frame time (us, ms, s); what fells "
       "bodies that should stand is not chosen")  //
      ("tolerance", po::value<std::string>()->value_name("LENGTH"),
       "name, per scene, the cheapest setting that keeps its defect within this length (mm, cm, m), with the "
       "same exception")  //
      ("measure", po::value<std::string>()->default_value("rms")->value_name("rms|p99|max|joint"),
       "the defect that counts: rms, p99 or max of all body positions, or the rms of all joint gaps");
  add_scene_choice(choose);
  po::options_description write("What to write");
  add_output_options("work-precision diagrams, Pareto fronts, categories", write);
  write.add_options()  //
      ("write-config", po::value<std::string>()->value_name("OUT"),
       "the setting chosen for one scene, for pbmpi --config")  //
      ("json", "print the fronts and the choices as one JSON document");
  po::options_description general("General");
  add_general_options("--json", general);
  po::options_description all;
  all.add(choose).add(write).add(general);
  return all;
}

}  // namespace

Manual study_manual() {
  return {.name = "pbreport study",
          .about =
              "pbreport study shows what accuracy costs in time: the file of pbstudy accuracy. The word "
              "study may be left out.",
          .usage = "pbreport [study] accuracy.h5 [options]",
          .options = visible_options(),
          .examples = {"pbreport accuracy.h5 --budget 3.33ms",
                       "pbreport accuracy.h5 --scene CrashWa --tolerance 1cm --write-config CrashWa.cfg"}};
}

AccuracyReportOptions parse_study_options(const std::vector<std::string>& args) {
  const po::variables_map values = parse_with_files(args, visible_options());
  AccuracyReportOptions options;
  static_cast<ReportOfStudyOptions&>(options) = report_of_study_options(values, "a study", "accuracy.h5");
  if (options.help) return options;
  const std::string measure = values["measure"].as<std::string>();
  const auto known = model::enum_from_name<ErrorMeasure>(measure, measure_names);
  require_input(known.has_value(), "--measure " + measure + ": it must be rms, p99, max or joint");
  options.measure = *known;
  if (values.count("budget") != 0)
    options.budget_s = parse_time_s(values["budget"].as<std::string>(), "--budget");
  if (values.count("tolerance") != 0) {
    options.tolerance_m = parse_length_m(values["tolerance"].as<std::string>(), "--tolerance");
  }
  options.config = output_path(values, "write-config");
  require_input(!options.config || options.budget_s || options.tolerance_m,
                "--write-config writes the setting that --budget or --tolerance chooses; give one of them");
  require_input(!options.budget_s || !options.tolerance_m,
                "--budget and --tolerance exclude each other; drop one");
  return options;
}

}  // namespace pbmpi::app
