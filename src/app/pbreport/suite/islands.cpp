#include "app/pbreport/suite/islands.h"

#include <nlohmann/json.hpp>
#include <ostream>

#include "app/common/format.h"
#include "app/common/json_text.h"
#include "app/common/options.h"
#include "app/common/text_output.h"
#include "app/pbreport/suite/characterise.h"

namespace pbmpi::app {
namespace {

namespace po = boost::program_options;
using nlohmann::ordered_json;

po::options_description visible_options() {
  po::options_description all("Options");
  add_help_options(all);
  all.add_options()("json", "print one JSON document");
  return all;
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

ordered_json relative(double ours, double papers) {
  if (papers == 0) return ours == 0 ? ordered_json(0) : ordered_json(nullptr);
  return (ours - papers) / papers;
}

ordered_json counts(double max, double min, double mean, double stddev) {
  return {{"max", max}, {"min", min}, {"mean", mean}, {"stddev", stddev}};
}

/// Paper and relative difference are null where the paper lacks the scene or the number.
ordered_json to_json(const IslandSummary& s) {
  ordered_json json;
  json["scene"] = s.scene;
  json["islands"] = counts(s.islands.max, s.islands.min, s.islands.mean, s.islands.stddev);
  json["spaces"] = s.spaces;
  json["cross_space_contacts_per_step"] =
      s.has_profile ? ordered_json(s.cross_contacts) : ordered_json(nullptr);
  json["paper"] = nullptr;
  json["relative_difference"] = nullptr;
  if (const PaperRow* paper = paper_row(s.scene)) {
    json["paper"] =
        counts(paper->islands_max, paper->islands_min, paper->islands_mean, paper->islands_stddev);
    json["paper"]["spaces"] = paper->spaces;
    json["paper"]["traffic"] = paper->traffic;
    json["relative_difference"] = {{"max", relative(s.islands.max, paper->islands_max)},
                                   {"min", relative(s.islands.min, paper->islands_min)},
                                   {"mean", relative(s.islands.mean, paper->islands_mean)},
                                   {"stddev", relative(s.islands.stddev, paper->islands_stddev)}};
  }
  return json;
}

}  // namespace

Manual islands_manual() {
  return {
      .name = "pbreport islands",
      .about =
          "pbreport islands shows the paper's Table 1 from runs: islands at the end of each measured frame.",
      .usage = "pbreport islands FILE... [options]",
      .options = visible_options()};
}

core::ExitCode run_islands(const std::vector<std::string>& args, std::ostream& out) {
  const po::variables_map values = parse_with_files(args, visible_options());
  if (values.count("help") != 0) {
    out << help_of(islands_manual());
    return core::ExitCode::done;
  }
  const std::vector<std::string> files = given_files(values);
  core::require_input(!files.empty(), "no file given; name the HDF5 files of runs, e.g. CrashSk.h5 Fight.h5");
  auto json = ordered_json::array();
  std::string text = "scene     islands  max   min    mean    dev\n";
  for (const std::string& file : files) {
    const IslandSummary summary = summarize_islands(io::read_run(file));
    json.push_back(to_json(summary));
    text += islands_text(summary);
  }
  out << (values.count("json") != 0 ? json_text(json, 2) + "\n" : text);
  require_printed(out, "the table");
  return core::ExitCode::done;
}

}  // namespace pbmpi::app
