#include "app/pbreport/calibrate/calibrate_report_options.h"

#include <array>
#include <string_view>

#include "app/common/options.h"
#include "app/common/quantities.h"
#include "app/pbreport/calibrate/calibrate_report.h"
#include "core/error.h"
#include "stepping/frame.h"

namespace pbmpi::app {
namespace {

namespace po = boost::program_options;
using core::require_input;

constexpr std::array<std::string_view, 4> table_names = {"costs", "forecasts", "walls", "checks"};
constexpr std::int64_t most_ranks = 1 << 20;
constexpr std::int64_t most_worlds = 1'000'000'000'000;

po::options_description calibrate_report_description() {
  po::options_description what("What to forecast");
  what.add_options()  //
      ("ranks", po::value<std::vector<std::int64_t>>()->multitoken()->value_name("LIST"),
       "numbers of ranks; default: 2 64 1024 16384 131072")  //
      ("worlds", po::value<std::vector<std::int64_t>>()->multitoken()->value_name("LIST"),
       "numbers of worlds; default: 100 10000 1000000 100000000")                                     //
      ("bodies", po::value<std::int64_t>()->default_value(37)->value_name("N"), "bodies of a world")  //
      ("world-step", po::value<std::string>()->default_value("0")->value_name("TIME"),
       "what a step of a world takes in its engine, e.g. 40us; 0: the harness alone");
  po::options_description write("What to write");
  add_print_options("print the tables in Markdown", write);
  add_table_options(table_names, "forecasts", write);
  po::options_description general("General");
  add_general_options("--json or --markdown", general);
  po::options_description all;
  all.add(what).add(write).add(general);
  return all;
}

std::vector<std::int64_t> numbers(const po::variables_map& values, const char* name,
                                  std::vector<std::int64_t> fallback, std::int64_t least, std::int64_t most) {
  if (values.count(name) == 0) return fallback;
  auto given = values[name].as<std::vector<std::int64_t>>();
  for (const std::int64_t number : given)
    require_input(number >= least && number <= most, "--" + std::string(name) + " " + std::to_string(number) +
                                                         ": it must be from " + std::to_string(least) +
                                                         " to " + std::to_string(most));
  return given;
}

}  // namespace

Manual calibrate_report_manual() {
  return {
      .name = "pbreport calibrate",
      .about =
          "pbreport calibrate shows what the harness costs beside the physics, and computes from it what a "
          "frame takes, sends and holds on numbers of ranks that were never there: the file of pbstudy "
          "calibrate. The word calibrate may be left out.",
      .usage = "pbreport [calibrate] calibrate.h5 [options]",
      .options = calibrate_report_description(),
      .examples = {"pbreport calibrate.h5", "pbreport calibrate.h5 --world-step 40us --ranks 64 256 1024"}};
}

CalibrateReportOptions parse_calibrate_report_options(const std::vector<std::string>& args) {
  const po::variables_map values = parse_with_files(args, calibrate_report_description());
  CalibrateReportOptions options;
  options.help = values.count("help") != 0;
  if (options.help) return options;
  const std::vector<std::string> files = given_files(values);
  require_input(!files.empty(),
                "no file given; name the file of a study of calibrate, e.g. pbreport calibrate.h5");
  require_input(files.size() == 1, "'" + files.back() + "' follows '" + files.front() + "': give one study");
  options.file = files.front();
  options.form = print_form(values);
  options.quiet = values.count("quiet") != 0;
  options.csv = output_path(values, "csv");
  options.table = chosen_table(values, table_names);
  ForecastQuestion& question = options.question;
  question.ranks = numbers(values, "ranks", question.ranks, 2, most_ranks);
  question.worlds = numbers(values, "worlds", question.worlds, 1, most_worlds);
  question.bodies = values["bodies"].as<std::int64_t>();
  require_input(question.bodies >= 0 && question.bodies <= 1'000'000,
                "--bodies: it must be from 0 to 1000000");
  const std::string step = values["world-step"].as<std::string>();
  question.step_s = step == "0" ? 0 : parse_time_or_seconds(step, "--world-step");
  question.budget_s = stepping::default_frame_budget_s;
  return options;
}

}  // namespace pbmpi::app
