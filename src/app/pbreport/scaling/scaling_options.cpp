#include "app/pbreport/scaling/scaling_options.h"

#include "app/common/options.h"
#include "app/pbreport/scaling/scaling_tables.h"
#include "core/error.h"

namespace pbmpi::app {
namespace {

namespace po = boost::program_options;
using core::require_input;

po::options_description visible_options() {
  const ScalingRules rules;
  po::options_description what("What to report");
  what.add_options()  //
      ("least-repeats", po::value<int>()->default_value(rules.least_repeats)->value_name("N"),
       "runs of a point, and of the one it is compared with, below which it is not reportable")  //
      ("widest-interval",
       po::value<double>()->default_value(rules.widest_interval, "0.1")->value_name("SHARE"),
       "of the median, above which a speed-up is not reportable");
  po::options_description write("What to write");
  add_print_options("print the points as tables in Markdown", write);
  write.add_options()("html", po::value<std::string>()->value_name("OUT"), "the curves as a page");
  add_table_options(scaling_table_names, "points", write);
  po::options_description general("General");
  add_general_options("--json or --markdown", general);
  po::options_description all;
  all.add(what).add(write).add(general);
  return all;
}

}  // namespace

Manual scaling_manual() {
  return {.name = "pbreport scaling",
          .about =
              "pbreport scaling compares runs of the same work on different numbers of ranks: speed-up and "
              "efficiency with their intervals, what takes the rest of the time, and which of the figures "
              "should not be reported, and why. jobs/scaling.sh makes such runs.",
          .usage = "pbreport scaling RUN.h5... [options]",
          .options = visible_options(),
          .examples = {"pbreport scaling scaling/*.h5 --html scaling.html",
                       "pbreport scaling scaling/*.h5 --csv points.csv"}};
}

ScalingOptions parse_scaling_options(const std::vector<std::string>& args) {
  const po::variables_map values = parse_with_files(args, visible_options());
  ScalingOptions options;
  options.help = values.count("help") != 0;
  if (options.help) return options;
  options.files = given_files(values);
  require_input(options.files.size() >= 2, "scaling: " + std::to_string(options.files.size()) +
                                               " files are given; name the HDF5 files of two runs or more");
  options.rules.least_repeats = values["least-repeats"].as<int>();
  require_input(options.rules.least_repeats >= 1, "--least-repeats: it must be at least 1");
  options.rules.widest_interval = values["widest-interval"].as<double>();
  require_input(options.rules.widest_interval > 0, "--widest-interval: it must be above 0");
  options.form = print_form(values);
  options.quiet = values.count("quiet") != 0;
  options.table = chosen_table(values, scaling_table_names);
  options.csv = output_path(values, "csv");
  options.html = output_path(values, "html");
  return options;
}

}  // namespace pbmpi::app
