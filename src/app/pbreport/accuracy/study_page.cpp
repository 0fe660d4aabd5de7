#include "app/pbreport/accuracy/study_page.h"

#include <algorithm>

#include "app/common/format.h"
#include "app/common/options.h"
#include "app/pbreport/accuracy/diagrams.h"
#include "app/pbreport/accuracy/study_text.h"
#include "io/html/chart_page.h"

namespace pbmpi::app {
namespace {

std::vector<std::string> table_row(const StudyCase& one, const AccuracyReportOptions& options,
                                   double floor_m) {
  const analysis::ErrorSummary& error = one.defect.body_position;
  std::vector<std::string> row = {
      setting_text(one),
      format("%.3f", 1e3 * one.time_s),
      format("%.0f", one.row_visits),
      format("%.4g", 1e3 * error.rms),
      format("%.4g", 1e3 * error.p99),
      format("%.4g", 1e3 * error.max),
      one.has_own() ? format("%.4g", 1e3 * one.own_defect.body_position.rms) : "-",
      format("%.4g", 1e3 * one.joint_gap_m)};
  for (const std::int64_t count : error.bands) row.push_back(std::to_string(count));
  row.push_back(remarks_text(one, one.error_m(options.measure) <= floor_m));
  return row;
}

io::html::TextTable table_of(const char* title, const char* first, const char* time) {
  io::html::TextTable table{
      title, {first, time, "row visits", "rms mm", "p99 mm", "max mm", "own rms mm", "joint gap mm"}, {}};
  for (const std::string_view band : analysis::position_band_names) table.header.emplace_back(band);
  table.header.emplace_back("remarks");
  return table;
}

io::html::TextTable front_table(const SceneCases& scene, const AccuracyReportOptions& options) {
  io::html::TextTable table = table_of("Pareto front", "setting (substeps x iterations)", "worst frame ms");
  const auto chosen = chosen_setting(scene, options);
  for (const std::size_t i : scene.pareto_front(options.measure)) {
    table.rows.push_back(table_row(scene.settings[i], options, scene.floor_m(options.measure)));
    std::string& remarks = table.rows.back().back();
    if (i == chosen) remarks = "chosen" + (remarks.empty() ? "" : "; " + remarks);
  }
  return table;
}

io::html::TextTable estimate_table(const SceneCases& scene, const AccuracyReportOptions& options) {
  io::html::TextTable table =
      table_of("Estimates (FEEC)", "setting, and what estimates its frame", "until it is there ms");
  for (const StudyCase& one : scene.estimates)
    table.rows.push_back(table_row(one, options, scene.floor_m(options.measure)));
  return table;
}

std::string blown_up_text(const SceneCases& scene) {
  const auto count =
      std::ranges::count_if(scene.settings, [](const StudyCase& one) { return !one.finite(); });
  if (count == 0) return "";
  return format(" %td of them blew up (inf or NaN) and %s not drawn.", count, count == 1 ? "is" : "are");
}

io::html::PageSection section_of(const SceneCases& scene, const AccuracyReportOptions& options) {
  io::html::PageSection section;
  section.title = scene.name;
  section.text = format(
      "%zu settings.%s Defect: error of all bodies after one frame from the reference's own state. "
      "Uncertainty of the reference: its largest distance from itself with %zu other solver %s and more "
      "iterations, and from a second method.",
      scene.settings.size(), blown_up_text(scene).c_str(), scene.floor.size(),
      scene.floor.size() == 1 ? "seed" : "seeds");
  if (scene.reference)
    section.text += format(" It was solved to %.3g mm a step, with %.0f iterations on average.",
                           1e3 * scene.reference->solve_residual_m, scene.reference->solve_iterations);
  if (!scene.own.empty())
    section.text +=
        " Own rms: the error against the same equations solved by the same stepper with many iterations.";
  if (const auto chosen = chosen_setting(scene, options)) {
    const StudyCase& one = scene.settings[*chosen];
    section.text += "\n\nChosen: " + setting_text(one) +
                    format(", %.3f ms, defect %.4g mm%s.", 1e3 * one.time_s,
                           1e3 * one.error_m(options.measure), inside_text(scene, one, options).c_str());
  }
  section.charts = {
      diagram(
          scene, options, "Position, rms", "defect, rms [mm]",
          [](const StudyCase& one) { return 1e3 * one.defect.body_position.rms; }, ErrorMeasure::rms),
      diagram(
          scene, options, "Position, 99th percentile", "defect, p99 [mm]",
          [](const StudyCase& one) { return 1e3 * one.defect.body_position.p99; }, ErrorMeasure::p99),
      diagram(
          scene, options, "Position, worst body", "defect, max [mm]",
          [](const StudyCase& one) { return 1e3 * one.defect.body_position.max; }, ErrorMeasure::max),
      diagram(
          scene, options, "Joint gap", "difference of the gaps, rms [mm]",
          [](const StudyCase& one) { return 1e3 * one.defect.joint_position.rms; }, ErrorMeasure::joint),
  };
  section.tables = {front_table(scene, options)};
  if (!scene.estimates.empty()) section.tables.push_back(estimate_table(scene, options));
  return section;
}

}  // namespace

void write_study_page(const std::string& path, const io::TableFile& file,
                      const std::vector<SceneCases>& scenes, const AccuracyReportOptions& options) {
  io::html::ChartPage page;
  page.title = "What accuracy costs in time";
  page.subtitle = options.file;
  page.provenance = io::html::provenance_of(options.file, file, version_line("pbreport"));
  for (const SceneCases& scene : scenes) page.sections.push_back(section_of(scene, options));
  io::html::write_chart_page(path, page);
}

}  // namespace pbmpi::app
