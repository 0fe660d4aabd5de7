#include "app/pbreport/instructions/figure3.h"

#include <ostream>

#include "app/common/options.h"
#include "app/common/text_output.h"
#include "app/pbreport/instructions/figure3_page.h"

namespace pbmpi::app {
namespace {

namespace po = boost::program_options;

po::options_description visible_options() {
  po::options_description all("Options");
  all.add_options()("html", po::value<std::string>()->value_name("OUT"), "one self-contained page");
  add_help_options(all);
  all.add_options()("quiet,q", "print nothing but errors");
  return all;
}

}  // namespace

Manual figure3_manual() {
  return {.name = "pbreport figure3",
          .about =
              "pbreport figure3 shows instructions of a frame by quick and direct, and their mix, as "
              "jobs/figure3.sh counts them. Where direct was not counted it is extrapolated by the rows of "
              "the islands, if a run of that scene with --record-islands is named.",
          .usage = "pbreport figure3 figure3.json [RUN.h5...] [options]",
          .options = visible_options()};
}

core::ExitCode run_figure3(const std::vector<std::string>& args, std::ostream& out) {
  const po::variables_map values = parse_with_files(args, visible_options());
  if (values.count("help") != 0) {
    out << help_of(figure3_manual());
    return core::ExitCode::done;
  }
  const std::vector<std::string> files = given_files(values);
  core::require_input(!files.empty(), "figure3: no file given; name the figure3.json of jobs/figure3.sh");
  const std::vector<CountedScene> scenes = read_counts(files.front());
  std::vector<IslandWork> works;
  std::vector<io::html::FileAttributes> runs = {{files.front(), {{"command_line", "jobs/figure3.sh"}}}};
  for (std::size_t i = 1; i < files.size(); ++i) {
    const io::RunData run = io::read_run(files[i]);
    works.push_back(island_work(run, files[i]));
    runs.emplace_back(files[i], run.attributes);
  }
  if (values.count("html") != 0) {
    io::html::ChartPage page{"Instructions of a frame",
                             "Figure 3 of Yeh, Faloutsos, Reinman 2006",
                             {figure3_section(scenes, works)}};
    page.provenance = io::html::provenance_of(runs, version_line("pbreport"));
    io::html::write_chart_page(values["html"].as<std::string>(), page);
  }
  if (values.count("quiet") == 0) out << figure3_text(scenes, works);
  require_printed(out, "the table");
  return core::ExitCode::done;
}

}  // namespace pbmpi::app
