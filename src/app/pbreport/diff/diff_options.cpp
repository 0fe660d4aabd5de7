#include "app/pbreport/diff/diff_options.h"

#include "app/common/options.h"
#include "core/error.h"
#include "core/system/paths.h"

namespace pbmpi::app {
namespace {

namespace po = boost::program_options;

po::options_description visible_options() {
  po::options_description what("What to compare");
  what.add_options()  //
      ("floor", po::value<std::vector<std::string>>()->multitoken()->value_name("FILE..."),
       "the noise floor: runs like REFERENCE in all but --solver-seed")  //
      ("output,o", po::value<std::string>()->value_name("FILE"),
       "write errors and categories of each frame, and of each actor, into an HDF5 file")  //
      ("html", po::value<std::string>()->value_name("OUT"),
       "one self-contained page: errors and constraints as curves over the frames")  //
      ("json", "print one JSON document");
  po::options_description general("General");
  add_help_options(general);
  po::options_description all;
  all.add(what).add(general);
  return all;
}

}  // namespace

Manual diff_manual() {
  return {.name = "pbreport diff",
          .about =
              "pbreport diff shows how far two recorded runs of the same bodies are apart: drift, along the "
              "trajectory, over the measured frames; where RUN has estimates (FEEC), their defect too.",
          .usage = "pbreport diff RUN.h5 REFERENCE.h5 [options]",
          .options = visible_options(),
          .examples = {"pbreport diff iter19.h5 iter20.h5",
                       "pbreport diff iter19.h5 iter20.h5 --floor seed2.h5 seed3.h5 --json"}};
}

DiffOptions parse_diff_options(const std::vector<std::string>& args) {
  const po::variables_map values = parse_with_files(args, visible_options());
  DiffOptions options;
  options.help = values.count("help") != 0;
  options.json = values.count("json") != 0;
  if (options.help) return options;
  const auto files = given_files(values);
  core::require_input(files.size() == 2, "diff: " + std::to_string(files.size()) +
                                             " files are given; it compares two, RUN and REFERENCE (those of "
                                             "--floor come last)");
  options.run = files[0];
  options.reference = files[1];
  options.html = output_path(values, "html");
  if (values.count("floor") != 0) options.floor = values["floor"].as<std::vector<std::string>>();
  if (values.count("output") != 0) {
    options.output = values["output"].as<std::string>();
    std::vector<core::NamedPath> paths = {{"RUN", options.run, false},
                                          {"REFERENCE", options.reference, false},
                                          {"--output", *options.output, true}};
    for (const std::string& path : options.floor) paths.push_back({"--floor", path, false});
    core::require_separate(paths);
  }
  return options;
}

}  // namespace pbmpi::app
