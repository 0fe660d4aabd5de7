#include "app/pbreport/figures/figures.h"

#include <ostream>

#include "app/common/format.h"
#include "app/common/options.h"
#include "app/common/text_output.h"
#include "app/pbreport/figures/figures_page.h"

namespace pbmpi::app {
namespace {

namespace po = boost::program_options;

po::options_description visible_options() {
  po::options_description all("Options");
  all.add_options()  //
      ("html", po::value<std::string>()->value_name("OUT"), "one self-contained page with both figures");
  add_help_options(all);
  all.add_options()("quiet,q", "print nothing but errors");
  return all;
}

std::string to_text(const std::vector<FigureScene>& scenes) {
  std::string text = format("%-9s %-20s %11s %10s %10s %8s  %s\n", "scene", "method", "rate Hz", "satisfied",
                            "ms", "ratio", "position errors: < 1 cm/1-10/10-100/> 100/inf");
  const auto bands = [](const analysis::ErrorTable& table) {
    std::string counts;
    for (const std::int64_t count : table.body_position.bands) {
      counts += (counts.empty() ? "" : "/") + std::to_string(count);
    }
    return counts;
  };
  for (const FigureScene& scene : scenes) {
    for (const FigureMethod& method : scene.methods) {
      text += format("%-9s %-20s %11.1f %8.0f %% %10.3f %8s  %s\n", scene.name.c_str(), method.label.c_str(),
                     method.frame_rate_hz, 100 * method.satisfied_fraction, 1e3 * method.mean_frame_s,
                     method.is_estimate ? format("%.2f", scene.ratio(method)).c_str() : "",
                     bands(method.errors).c_str());
    }
    for (const analysis::ErrorTable& floor : scene.floor) {
      text += format("%-9s %-20s %11s %10s %10s %8s  %s\n", scene.name.c_str(), "another seed", "", "", "",
                     "", bands(floor).c_str());
    }
  }
  for (const std::string& label : method_labels(scenes)) {
    const double ratio = mean_ratio(scenes, label);
    if (ratio <= 0) continue;
    text += format("precise_over_delivery: %s: mean %.2f over %zu scenes (%+.0f %%; the paper: +220 %%)\n",
                   label.c_str(), ratio, scenes.size(), 100 * (ratio - 1));
  }
  return text;
}

}  // namespace

Manual figures_manual() {
  return {.name = "pbreport figures",
          .about =
              "pbreport figures draws figures 8 and 9 of the paper from recorded runs: frame rates and "
              "satisfied frames, and the error categories against 20 iterations. What a file is (IterN, "
              "FEEC, another seed for the noise floor) it says itself; several files of one kind are "
              "repeats, and the time of a frame is the least of them. jobs/figure8_9.sh records them.",
          .usage = "pbreport figures RUN.h5... [options]",
          .options = visible_options()};
}

core::ExitCode run_figures(const std::vector<std::string>& args, std::ostream& out) {
  const po::variables_map values = parse_with_files(args, visible_options());
  if (values.count("help") != 0) {
    out << help_of(figures_manual());
    return core::ExitCode::done;
  }
  core::require_input(values.count("file") != 0,
                      "figures: no file given; name recorded runs (jobs/figure8_9.sh)");
  const auto [scenes, files] = recorded_figures(given_files(values));
  if (values.count("html") != 0) {
    io::html::ChartPage page = figures_page(scenes);
    page.provenance = io::html::provenance_of(files, version_line("pbreport"));
    io::html::write_chart_page(values["html"].as<std::string>(), page);
  }
  if (values.count("quiet") == 0) out << to_text(scenes);
  require_printed(out, "the table");
  return core::ExitCode::done;
}

}  // namespace pbmpi::app
