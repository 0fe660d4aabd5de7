#include "app/pbreport/suite/suite_commands.h"

#include <iterator>
#include <nlohmann/json.hpp>
#include <optional>
#include <ostream>

#include "app/common/format.h"
#include "app/common/json_text.h"
#include "app/common/options.h"
#include "app/common/text_output.h"
#include "app/pbreport/suite/characterise.h"
#include "app/pbreport/suite/suite_json.h"
#include "core/system/input_file.h"
#include "io/html/suite_page.h"

namespace pbmpi::app {
namespace {

namespace po = boost::program_options;
using nlohmann::ordered_json;

struct SuiteOptions {
  bool help = false, json = false;
  std::vector<std::string> files;
  std::string html, stills;
};

po::options_description described(bool page) {
  po::options_description all("Options");
  add_help_options(all);
  if (page) {
    all.add_options()  //
        ("html", po::value<std::string>()->value_name("OUT"), "the page to write")(
            "stills", po::value<std::string>()->value_name("DIR"),
            "folder with SCENE.png: a picture of each scene for the page");
  } else {
    all.add_options()("json", "print one JSON document");
  }
  return all;
}

SuiteOptions parse(const std::vector<std::string>& args, bool page) {
  const po::variables_map values = parse_with_files(args, described(page));
  SuiteOptions options;
  options.help = values.count("help") != 0;
  options.json = values.count("json") != 0;
  options.files = given_files(values);
  if (values.count("html") != 0) options.html = values["html"].as<std::string>();
  if (values.count("stills") != 0) options.stills = values["stills"].as<std::string>();
  core::require_input(options.help || !options.files.empty(),
                      "no file given; name the HDF5 files of runs, e.g. CrashSk.h5 Fight.h5");
  core::require_input(options.help || !page || !options.html.empty(),
                      "--html is missing; name the page to write");
  return options;
}

std::string percent(double ours, double papers) {
  if (papers == 0) return ours == 0 ? "0 %" : "-";
  return format("%+.0f %%", 100 * (ours - papers) / papers);
}

std::string islands_text(const IslandSummary& s) {
  const core::Summary& n = s.islands;
  std::string text = format("%-8s  %-5s  %5.0f %5.0f %7.1f %6.2f   spaces %-6d contacts across spaces %s\n",
                            s.scene.c_str(), "ours", n.max, n.min, n.mean, n.stddev, s.spaces,
                            s.has_profile ? format("%.1f", s.cross_contacts).c_str() : "not recorded");
  const PaperRow* p = paper_row(s.scene);
  if (p == nullptr) return text;
  text +=
      format("%-8s  %-5s  %5.0f %5.0f %7.1f %6.2f   spaces %-6s traffic %s\n", "", "paper", p->islands_max,
             p->islands_min, p->islands_mean, p->islands_stddev, p->spaces.c_str(), p->traffic.c_str());
  return text + format("%-8s  %-5s  %5s %5s %7s %6s\n", "", "diff", percent(n.max, p->islands_max).c_str(),
                       percent(n.min, p->islands_min).c_str(), percent(n.mean, p->islands_mean).c_str(),
                       percent(n.stddev, p->islands_stddev).c_str());
}

std::string rate_text(const Rate& rate) {
  return format("%9.1f Hz %4.0f %%", rate.harmonic_mean_hz, 100 * rate.satisfied_fraction);
}

std::string cores_text(const CoreSummary& s) {
  const PaperRow* paper = paper_row(s.scene);
  return format("%-8s  %5d %7.1f  %5s   %4.0f %%  ", s.scene.c_str(), s.cores, s.cores_mean,
                paper != nullptr ? std::to_string(paper->cores).c_str() : "-", 100 * s.longest_share) +
         rate_text(s.serial) + "  " + rate_text(s.islands_parallel) + "  " + rate_text(s.spaces_parallel) +
         format("   %3.0f %% -> %3.0f %%\n", 100 * s.collide_share_serial, 100 * s.collide_share_parallel);
}

core::ExitCode finish(std::ostream& out) {
  require_printed(out, "the table");
  return core::ExitCode::done;
}

/// "data:image/png;base64,..." or empty.
std::string still_of(const std::string& folder, const std::string& scene) {
  if (folder.empty()) return "";
  const std::string path = folder + "/" + scene + ".png";
  return core::read_input_file(path, "make it with jobs/stills.sh, or leave --stills out");
}

}  // namespace

Manual islands_manual() {
  return {
      .name = "pbreport islands",
      .about =
          "pbreport islands shows the paper's Table 1 from runs: islands at the end of each measured frame.",
      .usage = "pbreport islands FILE... [options]",
      .options = described(false)};
}

Manual cores_manual() {
  return {.name = "pbreport cores",
          .about =
              "pbreport cores shows the paper's Table 2 and Figure 6 from runs with --record-islands on one "
              "rank: the fewest cores on which the islands of a step, longest first, take no longer than the "
              "longest of them, and the frame rate (share of frames within 3.33 ms) if islands, then also "
              "spaces, had a core each.",
          .usage = "pbreport cores FILE... [options]",
          .options = described(false)};
}

Manual figure6_manual() {
  return {.name = "pbreport figure6",
          .about =
              "pbreport figure6 writes one page with the paper's Figure 6 and Tables 1 and 2, from runs as "
              "'cores' wants them.",
          .usage = "pbreport figure6 FILE... [options]",
          .options = described(true)};
}

core::ExitCode run_islands(const std::vector<std::string>& args, std::ostream& out) {
  const SuiteOptions options = parse(args, false);
  if (options.help) {
    out << help_of(islands_manual());
    return finish(out);
  }
  auto json = ordered_json::array();
  if (!options.json) out << "scene     islands  max   min    mean    dev\n";
  for (const std::string& file : options.files) {
    const IslandSummary summary = summarize_islands(io::read_run(file));
    json.push_back(to_json(summary));
    if (!options.json) out << islands_text(summary);
  }
  if (options.json) out << json_text(json, 2) << "\n";
  return finish(out);
}

core::ExitCode run_cores(const std::vector<std::string>& args, std::ostream& out) {
  const SuiteOptions options = parse(args, false);
  if (options.help) {
    out << help_of(cores_manual());
    return finish(out);
  }
  auto json = ordered_json::array();
  if (!options.json) {
    out << "cores: fewest in the worst measured frame and mean, makespan at most "
        << format("%.0f %%", 100 * cores_tolerance) << " above the longest island\n"
        << "scene     cores    mean  paper  longest            serial   islands parallel   + spaces parallel "
           "  "
           "collide: serial, parallel\n";
  }
  for (const std::string& file : options.files) {
    const CoreSummary summary = summarize_cores(io::read_run(file), file);
    json.push_back(to_json(summary));
    if (!options.json) out << cores_text(summary);
  }
  if (options.json) out << json_text(json, 2) << "\n";
  return finish(out);
}

core::ExitCode run_figure6(const std::vector<std::string>& args, std::ostream& out) {
  const SuiteOptions options = parse(args, true);
  if (options.help) {
    out << help_of(figure6_manual());
    return finish(out);
  }
  std::vector<io::html::SuiteScene> scenes;
  std::vector<io::html::FileAttributes> runs;
  for (const std::string& file : options.files) {
    const io::RunData run = io::read_run(file);
    const IslandSummary islands = summarize_islands(run);
    scenes.push_back({json_text(to_json(islands)), json_text(to_json(summarize_cores(run, file))),
                      islands.scene, still_of(options.stills, islands.scene)});
    runs.emplace_back(file, run.attributes);
  }
  io::html::write_suite_page(options.html, scenes, io::html::provenance_of(runs, version_line("pbreport")));
  out << options.html << "\n";
  return finish(out);
}

}  // namespace pbmpi::app
