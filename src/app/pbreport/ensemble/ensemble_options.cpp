#include "app/pbreport/ensemble/ensemble_options.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "app/common/options.h"
#include "core/error.h"

namespace pbmpi::app {
namespace {

namespace po = boost::program_options;
using core::require_input;

constexpr std::array<std::string_view, 6> table_names = {"runs",   "frames", "positions",
                                                         "bodies", "worlds", "body_frames"};

po::options_description visible_options() {
  po::options_description what("What to compare");
  what.add_options()  //
      ("over", po::value<std::string>()->default_value("runs")->value_name("runs|worlds"),
       "what a sample is: a run, its worlds taken together, or each world of each run")  //
      ("quantiles", po::value<std::vector<double>>()->multitoken()->value_name("Q..."),
       "from 0 to 1; 0.05 0.25 0.5 0.75 0.95 by default")  //
      ("allow", po::value<std::vector<std::string>>()->multitoken()->value_name("NAME..."),
       "parameters that may differ beside seed and solver_seed, e.g. iterations");
  po::options_description write("What to write");
  add_print_options("print the summary as a table in Markdown", write);
  write.add_options()("output,o", po::value<std::string>()->value_name("FILE"), "all tables as an HDF5 file");
  add_table_options(table_names, "frames", write);
  write.add_options()("by-body", "also the table body_frames: each body in each recorded frame");
  po::options_description general("General");
  add_general_options("--json or --markdown", general);
  po::options_description all;
  all.add(what).add(write).add(general);
  return all;
}

}  // namespace

Manual ensemble_manual() {
  return {.name = "pbreport ensemble",
          .about =
              "pbreport ensemble compares runs of one scene that differ in --seed or --solver-seed: mean, "
              "spread and quantiles of observables and positions frame by frame, contacts and times of each "
              "world. Runs that differ in what decides over their results are refused.",
          .usage = "pbreport ensemble RUN.h5... [options]",
          .options = visible_options(),
          .examples = {"pbreport ensemble seed*.h5",
                       "pbreport ensemble seed*.h5 --output ensemble.h5 --csv frames.csv",
                       "pbreport ensemble 100CrSk.h5 --over worlds --markdown"}};
}

EnsembleOptions parse_ensemble_options(const std::vector<std::string>& args) {
  const po::variables_map values = parse_with_files(args, visible_options());
  EnsembleOptions options;
  options.help = values.count("help") != 0;
  if (options.help) return options;
  options.files = given_files(values);
  const std::string over = values["over"].as<std::string>();
  require_input(over == "runs" || over == "worlds", "--over " + over + ": it must be runs or worlds");
  options.over = over == "worlds" ? SampleOf::worlds : SampleOf::runs;
  const std::size_t least = options.over == SampleOf::runs ? 2 : 1;
  require_input(options.files.size() >= least,
                "ensemble: " + std::to_string(options.files.size()) +
                    " files are given; name the HDF5 files of two runs or more, or one with --over worlds");
  if (values.count("quantiles") != 0) options.quantiles = values["quantiles"].as<std::vector<double>>();
  for (const double q : options.quantiles)
    require_input(q >= 0 && q <= 1, "--quantiles: " + std::to_string(q) + " is not from 0 to 1");
  std::ranges::sort(options.quantiles);
  if (values.count("allow") != 0) options.allowed = values["allow"].as<std::vector<std::string>>();
  options.form = print_form(values);
  options.quiet = values.count("quiet") != 0;
  options.by_body = values.count("by-body") != 0;
  options.table = chosen_table(values, table_names);
  require_input(options.table != "body_frames" || options.by_body, "--table body_frames: it takes --by-body");
  options.csv = output_path(values, "csv");
  options.output = output_path(values, "output");
  return options;
}

}  // namespace pbmpi::app
