#include "app/pbreport/scaling/scaling_page.h"

#include <array>
#include <nlohmann/json.hpp>

#include "app/common/format.h"
#include "app/common/json_text.h"
#include "app/common/options.h"
#include "app/pbreport/scaling/scaling_text.h"
#include "core/clock.h"
#include "io/html/chart_page.h"

namespace pbmpi::app {
namespace {

using ChartJson = nlohmann::json;

/// Okabe and Ito, "Color Universal Design" (2008), and two greys: a colour for each phase.
constexpr std::array<const char*, core::num_phases> phase_colours = {
    "#56b4e9", "#f0e442", "#009e73", "#0072b2", "#cc79a7",
    "#d55e00", "#e69f00", "#000000", "#999999", "#c9c9c9"};

/// "2", or "1, worlds" where the point has another decomposition than the curve.
std::string label_of(const ScalingCurve& curve, const ScalingPoint& point) {
  const std::string ranks = std::to_string(point.ranks);
  return point.decomposition == curve.decomposition ? ranks : ranks + ", " + point.decomposition;
}

std::vector<std::string> labels_of(const ScalingCurve& curve) {
  std::vector<std::string> labels;
  for (const ScalingPoint& point : curve.points) labels.push_back(label_of(curve, point));
  return labels;
}

/// A line over the points of a curve; `value` gives a point's y.
template <class Value>
ChartJson line_of(const ScalingCurve& curve, const char* name, const char* colour, const Value& value) {
  ChartJson points = ChartJson::array();
  for (const ScalingPoint& point : curve.points) {
    const double y = value(point);
    points.push_back({{"x", label_of(curve, point)},
                      {"y", y},
                      {"label", format("%s, %s ranks: %.3g", name, label_of(curve, point).c_str(), y)}});
  }
  return {{"label", name}, {"data", points}, {"borderColor", colour}, {"backgroundColor", colour}};
}

ChartJson dashed(ChartJson line) {
  line["borderDash"] = {4, 4};
  line["pointRadius"] = 0;
  line["borderWidth"] = 1;
  return line;
}

ChartJson axis(const char* title) { return {{"title", {{"display", true}, {"text", title}}}}; }

io::html::Chart chart(const char* title, const std::string& text, const char* type, const ScalingCurve& curve,
                      ChartJson datasets, ChartJson scales) {
  scales["x"].update(axis("ranks"));
  const ChartJson config = {{"type", type},
                            {"data", {{"labels", labels_of(curve)}, {"datasets", std::move(datasets)}}},
                            {"options", {{"scales", std::move(scales)}}}};
  return {title, text, json_text(config)};
}

io::html::Chart speed_up_chart(const ScalingCurve& curve) {
  constexpr const char *measured = "#0072b2", *bound = "#7a8490";
  ChartJson lines = {line_of(curve, "median of ratios", measured,
                             [](const ScalingPoint& point) { return point.speed_up.median; }),
                     dashed(line_of(curve, "interval, low", measured,
                                    [](const ScalingPoint& point) { return point.speed_up.interval.low; })),
                     dashed(line_of(curve, "interval, high", measured,
                                    [](const ScalingPoint& point) { return point.speed_up.interval.high; })),
                     dashed(line_of(curve, "ideal", bound, [&](const ScalingPoint& point) {
                       return ideal_speed_up(curve, point);
                     }))};
  if (curve.decomposition == "spaces")
    lines.push_back(
        dashed(line_of(curve, "largest island on one rank", "#d55e00", [](const ScalingPoint& point) {
          return point.median_of(&ScalingRun::island_bound);
        })));
  const auto add_bar = [&](const char* name, const char* colour, double value) {
    lines.push_back(dashed(line_of(curve, name, colour, [=](const ScalingPoint&) { return value; })));
  };
  if (curve.figure6) {
    add_bar("Figure 6: a core an island", "#e69f00", curve.figure6->islands);
    add_bar("Figure 6: and a core a space", "#009e73", curve.figure6->spaces);
  }
  return chart("Speed-up", base_text(curve), "line", curve, std::move(lines),
               {{"y", axis("worlds a second, over the base's")}});
}

io::html::Chart factors_chart(const ScalingCurve& curve) {
  const auto factor = [&](const char* name, const char* colour, auto value) {
    return line_of(curve, name, colour, [=](const ScalingPoint& point) { return 100 * value(point); });
  };
  const auto median = [](double PopEfficiencies::*value) {
    return [=](const ScalingPoint& point) { return point.median_of(value); };
  };
  ChartJson lines = {
      factor("efficiency", "#000000", [](const ScalingPoint& point) { return point.efficiency.median; }),
      factor("load balance", "#0072b2", median(&PopEfficiencies::load_balance)),
      factor("serialisation", "#d55e00", median(&PopEfficiencies::serialisation)),
      factor("transfer", "#009e73", median(&PopEfficiencies::transfer)),
      factor("computation", "#cc79a7", [](const ScalingPoint& point) { return point.computation; })};
  return chart(
      "What the efficiency is made of",
      "Factors of the POP centre of excellence, medians of the runs; their product, over the base's, "
      "is the efficiency.",
      "line", curve, std::move(lines), {{"y", axis("%")}});
}

io::html::Chart phases_chart(const ScalingCurve& curve) {
  ChartJson bars = ChartJson::array();
  for (std::size_t i = 0; i < core::phase_names.size(); ++i) {
    const std::string phase(core::phase_names[i]);
    bars.push_back(line_of(curve, phase.c_str(), phase_colours[i],
                           [&](const ScalingPoint& point) { return 1e3 * phase_s(point, phase); }));
  }
  ChartJson y = axis("ms");
  y["stacked"] = true;
  return chart("Time of a frame", "Mean of the ranks, median of the runs.", "bar", curve, std::move(bars),
               {{"x", {{"stacked", true}}}, {"y", y}});
}

io::html::PageSection section_of(const ScalingCurve& curve) {
  io::html::PageSection section;
  section.title = title_of(curve);
  for (const ScalingPoint& point : curve.points) {
    if (point.doubts.empty()) continue;
    section.text += (section.text.empty() ? "Not reportable: on " : "; on ") + label_of(curve, point) +
                    (point.ranks == 1 ? " rank, " : " ranks, ") + doubts_text(point);
  }
  if (!section.text.empty()) section.text += ".";
  section.charts = {speed_up_chart(curve), factors_chart(curve), phases_chart(curve)};
  std::vector<std::vector<std::string>> cells = point_cells(curve);
  section.tables = {{"Points", cells.front(), {cells.begin() + 1, cells.end()}}};
  return section;
}

}  // namespace

void write_scaling_page(const std::string& path, const std::vector<ScalingRun>& runs,
                        const std::vector<ScalingCurve>& curves) {
  std::vector<io::html::FileAttributes> files;
  files.reserve(runs.size());
  for (const ScalingRun& run : runs) files.emplace_back(run.path, run.attributes);
  io::html::ChartPage page;
  page.title = "Scaling";
  page.subtitle = format(
      "%zu curve%s of %zu runs. Intervals hold the median with the confidence that the "
      "number of runs allows, 95 %% from six on, 93.8 %% with five.",
      curves.size(), curves.size() == 1 ? "" : "s", runs.size());
  for (const ScalingCurve& curve : curves) page.sections.push_back(section_of(curve));
  page.provenance = io::html::provenance_of(files, version_line("pbreport"));
  io::html::write_chart_page(path, page);
}

}  // namespace pbmpi::app
