#include "app/pbreport/diff/diff_page.h"

#include <fmt/core.h>
#include <algorithm>
#include <functional>
#include <nlohmann/json.hpp>
#include <numeric>

#include "app/common/json_text.h"
#include "app/common/options.h"
#include "io/html/chart_page.h"
#include "io/html/plot_data.h"

namespace pbmpi::app {
namespace {

using analysis::ErrorSummary;
using ChartJson = nlohmann::json;

/// A curve: one number for each frame.
struct Line {
  std::string label;
  const char* colour;
  bool is_dashed;
  std::vector<double> values;
};

constexpr const char *blue = "#0072b2", *orange = "#d55e00";

/// How many frames share a point: more frames than fit are drawn in bins, by the bin's largest value.
std::size_t frames_a_point(const RunComparison& c) {
  return std::max<std::size_t>((c.num_frames + io::html::max_plot_points - 1) / io::html::max_plot_points, 1);
}

io::html::Chart chart_of(const RunComparison& c, const std::string& title, const std::string& text,
                         const std::string& axis, const std::vector<Line>& lines) {
  const std::size_t per_point = frames_a_point(c);
  std::vector<std::string> labels;
  for (std::size_t i = 0; i < c.times_s.size(); i += per_point)
    labels.push_back(fmt::format("{:.4g}", c.times_s[i]));
  ChartJson datasets = ChartJson::array();
  for (const Line& line : lines) {
    ChartJson dataset = {
        {"label", line.label},        {"data", io::html::largest_of_bins(line.values, per_point)},
        {"borderColor", line.colour}, {"backgroundColor", line.colour},
        {"borderWidth", 1.5},         {"pointRadius", 0}};
    if (line.is_dashed) dataset["borderDash"] = {5, 4};
    datasets.push_back(std::move(dataset));
  }
  const auto scale = [](const std::string& name) {
    return ChartJson{{"title", {{"display", true}, {"text", name}}}};
  };
  const ChartJson config = {
      {"type", "line"},
      {"data", {{"labels", labels}, {"datasets", datasets}}},
      {"options", {{"scales", {{"x", scale("simulated time [s]")}, {"y", scale(axis)}}}}}};
  return {title, text, json_text(config)};
}

std::vector<double> numbers(std::size_t count, const std::function<double(std::size_t)>& of) {
  std::vector<double> values;
  for (std::size_t i = 0; i < count; ++i) values.push_back(of(i));
  return values;
}

/// "joint gap" from "joint_gap".
std::string spoken(std::string name) {
  std::ranges::replace(name, '_', ' ');
  return name;
}

io::html::PageSection drift_section(const RunComparison& c) {
  io::html::PageSection section;
  section.title = "How far the run is from the reference";
  section.text =
      fmt::format("Drift along the trajectory, frame by frame, over the {} measured frames that both have.",
                  c.num_frames);
  if (frames_a_point(c) > 1)
    section.text += fmt::format(" A point is the largest of {} frames.", frames_a_point(c));
  for (const analysis::NamedSummary& named : analysis::error_columns) {
    const auto line = [&](const char* label, const char* colour, double ErrorSummary::*number) {
      return Line{label, colour, false, numbers(c.num_frames, [&](std::size_t i) {
                    return c.drift_by_frame[i].*named.summary.*number;
                  })};
    };
    section.charts.push_back(chart_of(
        c, spoken(named.name), "Of all finite errors of the frame.", fmt::format("error [{}]", named.unit),
        {line("largest", orange, &ErrorSummary::max), line("rms", blue, &ErrorSummary::rms)}));
  }
  return section;
}

/// Curves of one constraint, for the runs that have recorded it.
std::vector<Line> constraint_lines(const RunComparison& c, const NamedConstraint& named) {
  std::vector<Line> lines;
  const auto add = [&](const std::string& whose, const char* colour,
                       const std::optional<RunConstraints>& of_run) {
    if (!of_run || of_run->by_frame.empty() || named.summary(of_run->by_frame.front()) == nullptr) return;
    for (const bool largest : {true, false}) {
      lines.push_back({whose + (largest ? ", largest" : ", rms"), colour, !largest,
                       numbers(of_run->by_frame.size(), [&](std::size_t i) {
                         const ErrorSummary& summary = *named.summary(of_run->by_frame[i]);
                         return largest ? summary.max : summary.rms;
                       })});
    }
  };
  add("run", orange, c.run_constraints);
  add("reference", blue, c.reference_constraints);
  return lines;
}

io::html::PageSection constraint_section(const RunComparison& c) {
  io::html::PageSection section;
  section.title = "How far each run is from its own constraints";
  section.text =
      "Joints that gape or are bent where they must not be; with --record-contacts, of the last step of each "
      "frame, "
      "how deep contacts are, and how far those slip that should stick.";
  for (const NamedConstraint& named : constraint_columns) {
    const std::vector<Line> lines = constraint_lines(c, named);
    if (!lines.empty())
      section.charts.push_back(
          chart_of(c, spoken(named.name), "", fmt::format("error [{}]", named.unit), lines));
  }
  return section;
}

/// The largest error of a constraint for an actor; empty where none is recorded.
std::string largest_of(const std::optional<RunConstraints>& of_run, std::size_t actor,
                       const NamedConstraint& named) {
  if (!of_run || actor >= of_run->by_actor.size()) return "";
  const ErrorSummary* summary = named.summary(of_run->by_actor[actor]);
  return summary == nullptr || summary->count == 0 ? "" : fmt::format("{:.3g}", summary->max);
}

io::html::PageSection actor_section(const RunComparison& c) {
  constexpr std::size_t most_rows = 40;
  std::vector<std::size_t> order(c.drift_by_actor.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) {
    return c.drift_by_actor[a].drift.body_position.rms > c.drift_by_actor[b].drift.body_position.rms;
  });
  io::html::TextTable table{"Actors", {"world", "actor", "drift rms [m]", "largest [m]"}, {}};
  for (const NamedConstraint& named : constraint_columns)
    table.header.push_back(fmt::format("run's largest {} [{}]", spoken(named.name), named.unit));
  for (std::size_t i = 0; i < std::min(order.size(), most_rows); ++i) {
    const ActorErrors& actor = c.drift_by_actor[order[i]];
    std::vector<std::string> row = {std::to_string(actor.actor.world), actor.actor.name,
                                    fmt::format("{:.3g}", actor.drift.body_position.rms),
                                    fmt::format("{:.3g}", actor.drift.body_position.max)};
    for (const NamedConstraint& named : constraint_columns)
      row.push_back(largest_of(c.run_constraints, order[i], named));
    table.rows.push_back(std::move(row));
  }
  io::html::PageSection section;
  section.title = "By actor";
  section.text = order.size() > most_rows
                     ? fmt::format("The {} of {} actors that are farthest off; --output FILE has all.",
                                   most_rows, order.size())
                     : "Those that are farthest off first.";
  section.tables = {table};
  return section;
}

}  // namespace

void write_diff_page(const std::string& path, const RunComparison& comparison,
                     const io::html::FileAttributes& run, const io::html::FileAttributes& reference) {
  io::html::ChartPage page;
  page.title = "Two runs compared";
  page.subtitle = run.first + " against " + reference.first;
  page.provenance = io::html::provenance_of({run, reference}, version_line("pbreport"));
  page.sections = {drift_section(comparison), constraint_section(comparison), actor_section(comparison)};
  io::html::write_chart_page(path, page);
}

}  // namespace pbmpi::app
