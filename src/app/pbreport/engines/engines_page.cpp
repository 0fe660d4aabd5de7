#include "app/pbreport/engines/engines_page.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "app/common/format.h"
#include "app/common/json_text.h"
#include "app/pbreport/accuracy/diagrams.h"
#include "app/pbreport/engines/engines_text.h"
#include "io/html/chart_page.h"
#include "stepping/names.h"

namespace pbmpi::app {
namespace {

using ChartJson = nlohmann::json;

ChartJson points_of(const EngineOfScene& engine, Yardstick yardstick) {
  ChartJson points = ChartJson::array();
  for (const std::size_t i : engine.front(yardstick)) {
    const StudyCase& one = engine.cases.settings[i];
    const double error_mm = 1e3 * error_m(one, yardstick), time_ms = 1e3 * one.time_s;
    points.push_back({{"x", time_ms},
                      {"y", error_mm},
                      {"label", setting_text(one) + format(": %.3f ms, %.4g mm, joint gap %.3g mm", time_ms,
                                                           error_mm, 1e3 * one.joint_gap_m)}});
  }
  return points;
}

/// Errors below these lines say nothing: the common reference's uncertainty, or each engine's own noise.
ChartJson lines_of(const SceneOfEngines& scene, Yardstick yardstick) {
  ChartJson lines = ChartJson::array();
  const auto add = [&](double at_mm, const std::string& label, const std::string& colour) {
    if (at_mm > 0)
      lines.push_back({{"from", at_mm},
                       {"to", at_mm},
                       {"axis", "y"},
                       {"label", label},
                       {"colour", colour},
                       {"dash", {3, 3}}});
  };
  if (yardstick == Yardstick::common)
    add(1e3 * scene.uncertainty_m, "uncertainty of the reference [mm]", "#7a8490");
  for (const EngineOfScene& engine : scene.engines) {
    if (yardstick == Yardstick::own)
      add(1e3 * engine.floor_m, "noise of " + std::string(stepping::name_of(engine.kind)) + " [mm]",
          engine_colour(engine.kind));
  }
  return lines;
}

io::html::Chart chart_of(const SceneOfEngines& scene, Yardstick yardstick) {
  ChartJson sets = ChartJson::array();
  for (const EngineOfScene& engine : scene.engines) {
    ChartJson points = points_of(engine, yardstick);
    if (points.empty()) continue;
    const std::string colour = engine_colour(engine.kind);
    sets.push_back({{"label", stepping::name_of(engine.kind)},
                    {"data", std::move(points)},
                    {"showLine", true},
                    {"borderColor", colour},
                    {"backgroundColor", colour},
                    {"borderWidth", 1.5},
                    {"pointRadius", 4}});
  }
  const auto axis = [](const std::string& text) {
    return ChartJson{{"type", "logarithmic"}, {"title", {{"display", true}, {"text", text}}}};
  };
  const ChartJson config = {
      {"type", "scatter"},
      {"data", {{"datasets", sets}}},
      {"options",
       {{"scales",
         {{"x", axis("time of the worst frame [ms]")}, {"y", axis("error after a frame, rms [mm]")}}},
        {"plugins", {{"pbmpi", {{"bands", lines_of(scene, yardstick)}}}}}}}};
  return {"Against " + name_of(yardstick), "Each engine's front; down and left is better.",
          json_text(config)};
}

io::html::TextTable on_page(const EnginesTable& table) {
  return {table.title, table.rows.front(), {table.rows.begin() + 1, table.rows.end()}};
}

io::html::PageSection section_of(const SceneOfEngines& scene) {
  io::html::PageSection section{.title = scene.name, .text = own_table(scene).text};
  for (const Yardstick yardstick : scene.yardsticks()) {
    const bool has_front = std::ranges::any_of(
        scene.engines, [yardstick](const EngineOfScene& engine) { return !engine.front(yardstick).empty(); });
    if (has_front) section.charts.push_back(chart_of(scene, yardstick));
    section.tables.push_back(on_page(front_table(scene, yardstick)));
  }
  if (scene.has_own_solutions()) section.tables.push_back(on_page(own_table(scene)));
  return section;
}

/// Verdicts: one row per hard case, one column per setting.
io::html::TextTable case_table(const EnginesReport& report) {
  io::html::TextTable table{"Case by case", {"case"}, {}};
  for (const std::string& setting : report.map->settings) table.header.push_back(setting);
  for (const StabilityScene& scene : report.map->scenes) {
    std::vector<std::string> row = {scene.name};
    for (const StabilityCell& cell : scene.cells) {
      const std::string decided = decided_text(cell);
      row.push_back(std::string(name_of(cell.judged.verdict)) + (decided.empty() ? "" : ": " + decided));
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

}  // namespace

void write_engines_page(const std::string& path, const EnginesReport& report) {
  io::html::ChartPage page;
  page.title = "Engines side by side";
  for (const StudySource& source : report.sources)
    page.subtitle += (page.subtitle.empty() ? "" : ", ") + source.file;
  page.provenance = report.provenance;
  for (const SceneOfEngines& scene : report.scenes) page.sections.push_back(section_of(scene));
  if (report.map)
    page.sections.push_back({.title = "Hard cases",
                             .text = verdict_table(report).text,
                             .charts = {},
                             .tables = {on_page(verdict_table(report)), case_table(report)}});
  io::html::PageSection limits{.title = "What is not comparable"};
  for (const std::string& paragraph : not_comparable())
    limits.text += (limits.text.empty() ? "" : "\n\n") + paragraph;
  limits.tables = {on_page(difference_table(report)), on_page(version_table(report))};
  page.sections.push_back(std::move(limits));
  io::html::write_chart_page(path, page);
}

}  // namespace pbmpi::app
