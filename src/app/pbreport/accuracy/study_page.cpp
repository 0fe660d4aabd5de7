#include "app/pbreport/accuracy/study_page.h"

#include <map>
#include <nlohmann/json.hpp>

#include "app/common/format.h"
#include "app/common/json_text.h"
#include "app/pbreport/accuracy/study_text.h"
#include "io/html/chart_page.h"
#include "stepping/step_options.h"

namespace pbmpi::app {
namespace {

using nlohmann::json;

/// Colours that people with any colour vision can tell apart: Okabe and Ito, "Color Universal Design" (2008).
const std::map<std::string, std::string>& stepper_colours() {
  static const std::map<std::string, std::string> colours = {
      {"quick", "#0072b2"}, {"direct", "#cc79a7"}, {"sor double", "#e69f00"}, {"sor single", "#009e73"}};
  return colours;
}

json point(const StudyCase& one, double y) {
  return {{"x", 1e3 * one.time_s},
          {"y", y},
          {"label", setting_text(one) + format(": %.3f ms, %.4g", 1e3 * one.time_s, y)}};
}

/// A logarithmic axis has no place for 0.
constexpr double least_shown = 1e-6;

using ErrorOf = double (*)(const StudyCase&);

json bands_of(const SceneCases& scene, ErrorOf error) {
  double floor = 0;
  for (const StudyCase& one : scene.floor) floor = std::max(floor, error(one));
  json bands = {{{"from", 0},
                 {"to", floor},
                 {"label", "noise floor"},
                 {"align", "left"},
                 {"colour", "rgba(120, 130, 142, .30)"}}};
  const auto add_line = [&](const std::optional<StudyCase>& halved, const char* label) {
    if (!halved) return;
    bands.push_back(
        {{"from", error(*halved)}, {"to", error(*halved)}, {"label", label}, {"colour", "#7a8490"}});
  };
  add_line(scene.halved_iterations, "reference: half the iterations");
  add_line(scene.halved_dt, "half the step");
  return bands;
}

io::html::Chart diagram(const SceneCases& scene, const char* title, const char* axis, ErrorOf error) {
  std::map<std::string, json> by_stepper;
  for (const StudyCase& one : scene.settings) {
    if (one.finite())
      by_stepper[stepper_text(one.stepper)].push_back(point(one, std::max(error(one), least_shown)));
  }
  json datasets = json::array();
  json front = json::array();
  for (const std::size_t i : scene.pareto_front(error)) {
    front.push_back(point(scene.settings[i], std::max(error(scene.settings[i]), least_shown)));
  }
  datasets.push_back({{"label", "Pareto front"},
                      {"data", front},
                      {"showLine", true},
                      {"borderColor", "#3d4650"},
                      {"borderWidth", 1.5},
                      {"pointRadius", 0}});
  for (const auto& [stepper, points] : by_stepper) {
    const std::string colour = stepper_colours().at(stepper);
    datasets.push_back(
        {{"label", stepper}, {"data", points}, {"backgroundColor", colour}, {"pointRadius", 3.5}});
  }
  const auto scale = [](const std::string& text) {
    return json{{"type", "logarithmic"}, {"title", {{"display", true}, {"text", text}}}};
  };
  const json config = {{"type", "scatter"},
                       {"data", {{"datasets", datasets}}},
                       {"options",
                        {{"scales", {{"x", scale("time of the worst frame [ms]")}, {"y", scale(axis)}}},
                         {"plugins", {{"pbmpi", {{"bands", bands_of(scene, error)}}}}}}}};
  return {title, "Each point is a setting; down and left is better.", json_text(config)};
}

io::html::TextTable front_table(const SceneCases& scene, const AccuracyReportOptions& options) {
  io::html::TextTable table;
  table.title = "Pareto front";
  table.header = {"setting (substeps x iterations)",
                  "worst frame ms",
                  "row visits",
                  "rms mm",
                  "p99 mm",
                  "max mm",
                  "joint gap mm"};
  for (const std::string_view band : analysis::position_band_names) table.header.emplace_back(band);
  table.header.emplace_back("");
  const double floor = scene.floor_m(options.measure);
  for (const std::size_t i : scene.pareto_front(options.measure)) {
    const StudyCase& one = scene.settings[i];
    const analysis::ErrorSummary& error = one.defect.body_position;
    std::vector<std::string> row = {setting_text(one),
                                    format("%.3f", 1e3 * one.time_s),
                                    format("%.0f", one.row_visits),
                                    format("%.4g", 1e3 * error.rms),
                                    format("%.4g", 1e3 * error.p99),
                                    format("%.4g", 1e3 * error.max),
                                    format("%.4g", 1e3 * one.joint_gap_m)};
    for (const std::int64_t count : error.bands) row.push_back(std::to_string(count));
    row.push_back(remarks_text(one, one.error_m(options.measure) <= floor));
    table.rows.push_back(std::move(row));
  }
  return table;
}

io::html::PageSection section_of(const SceneCases& scene, const AccuracyReportOptions& options) {
  io::html::PageSection section;
  section.title = scene.name;
  section.text = format(
      "%zu settings. Defect: error of all bodies after one frame from the reference's own state. "
      "Noise floor: the reference with %zu other solver seeds.",
      scene.settings.size(), scene.floor.size());
  if (const auto chosen = chosen_setting(scene, options)) {
    const StudyCase& one = scene.settings[*chosen];
    section.text +=
        "\n\nChosen: " + setting_text(one) +
        format(", %.3f ms, defect %.4g mm.", 1e3 * one.time_s, 1e3 * one.error_m(options.measure));
  }
  section.charts = {
      diagram(scene, "Position, rms", "defect, rms [mm]",
              [](const StudyCase& one) { return 1e3 * one.defect.body_position.rms; }),
      diagram(scene, "Position, 99th percentile", "defect, p99 [mm]",
              [](const StudyCase& one) { return 1e3 * one.defect.body_position.p99; }),
      diagram(scene, "Position, worst body", "defect, max [mm]",
              [](const StudyCase& one) { return 1e3 * one.defect.body_position.max; }),
      diagram(scene, "Joint gap", "difference of the joint gaps, rms [mm]",
              [](const StudyCase& one) { return 1e3 * one.defect.joint_position.rms; }),
  };
  section.tables = {front_table(scene, options)};
  return section;
}

}  // namespace

void write_study_page(const std::string& path, const std::vector<SceneCases>& scenes,
                      const AccuracyReportOptions& options) {
  io::html::ChartPage page;
  page.title = "What accuracy costs in time";
  page.subtitle = options.file;
  for (const SceneCases& scene : scenes) page.sections.push_back(section_of(scene, options));
  io::html::write_chart_page(path, page);
}

}  // namespace pbmpi::app
