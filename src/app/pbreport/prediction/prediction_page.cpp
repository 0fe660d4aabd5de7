#include "app/pbreport/prediction/prediction_page.h"

#include <nlohmann/json.hpp>
#include <string_view>

#include "app/common/format.h"
#include "app/common/json_text.h"
#include "app/common/options.h"
#include "app/pbreport/prediction/prediction_text.h"
#include "app/pbreport/prediction/prediction_verdicts.h"
#include "app/pbreport/study/error_text.h"
#include "io/html/chart_page.h"

namespace pbmpi::app {
namespace {

using ChartJson = nlohmann::json;

/// A colour for each bar: Okabe and Ito, "Color Universal Design" (2008).
constexpr std::array<const char*, 6> colours = {"#0072b2", "#56b4e9", "#e69f00",
                                                "#d55e00", "#009e73", "#cc79a7"};

/// Bars: one group per scene, one bar per way to compute its frames.
io::html::Chart bars(const PredictionStudy& study, double FrameRate::*number, double scale, const char* title,
                     const char* axis, const char* kind) {
  ChartJson labels = ChartJson::array(), datasets = ChartJson::array();
  for (const PredictionScene& scene : study.scenes) labels.push_back(scene.name);
  const std::vector<Bar> first = figure_8(study.scenes.front(), study.fvp);
  for (std::size_t i = 0; i < first.size(); ++i) {
    ChartJson points = ChartJson::array();
    for (const PredictionScene& scene : study.scenes) {
      const Bar bar = figure_8(scene, study.fvp)[i];
      const double y = scale * (bar.rate.*number);
      if (std::isfinite(y))
        points.push_back({{"x", scene.name}, {"y", y}, {"label", format("%s: %.4g", bar.name.c_str(), y)}});
    }
    datasets.push_back({{"label", first[i].name}, {"data", points}, {"backgroundColor", colours[i]}});
  }
  ChartJson y = {{"type", kind}, {"title", {{"display", true}, {"text", axis}}}};
  if (std::string_view(axis) == "%") y["max"] = 100;
  const ChartJson config = {{"type", "bar"},
                            {"data", {{"labels", labels}, {"datasets", datasets}}},
                            {"options", {{"scales", {{"y", y}}}}}};
  return {title, "", json_text(config)};
}

std::string cell(double value, const char* pattern, double scale) {
  return std::isfinite(value) ? format(pattern, scale * value) : "-";
}

io::html::TextTable verdicts(const PredictionStudy& study) {
  io::html::TextTable table{"The paper's statements", {"statement", "finding", "number", "confirmed if"}, {}};
  for (const PaperVerdict& verdict : judge_paper(study)) {
    table.rows.push_back({verdict.statement, name_of(verdict.finding), verdict.number, verdict.rule});
  }
  return table;
}

io::html::TextTable sensitivity(const PredictionStudy& study) {
  io::html::TextTable table{"What other processors would change",
                            {"scene", "case", "processor", "cycles", "with prediction", "gain"},
                            {}};
  for (const Sensitivity& row : study.sensitivity) {
    table.rows.push_back({row.scene, row.run, row.variant, format("%.0f", row.cycles),
                          format("%.0f", row.predicted_cycles),
                          format("%+.2f %%", 100 * (row.cycles / row.predicted_cycles - 1))});
  }
  return table;
}

io::html::TextTable engines(const PredictionStudy& study) {
  io::html::TextTable table{"Hits of floating-point results by engine, exact and " + study.fvp,
                            {"scene", "engine", "exact: coverage", "hit rate", "fuzzy: coverage", "hit rate",
                             "mean accepted error"},
                            {}};
  for (const PredictionScene& scene : study.scenes) {
    for (const EngineHits& hits : engine_hits(scene, study.fvp)) {
      table.rows.push_back(
          {scene.name, hits.engine, cell(hits.exact.coverage(), "%.1f %%", 100),
           cell(hits.exact.hit_rate(), "%.1f %%", 100), cell(hits.fuzzy.coverage(), "%.1f %%", 100),
           cell(hits.fuzzy.hit_rate(), "%.1f %%", 100), cell(hits.fuzzy.mean_error(), "%.1e", 1)});
    }
  }
  return table;
}

io::html::PageSection section_of(const PredictionScene& scene) {
  io::html::PageSection section;
  section.title = scene.name;
  section.text =
      format(
          "%d %s, %d + %d frames. Errors of positions against the unpredicted run; noise floor (another "
          "solver seed): %.3g mm, ",
          scene.worlds, scene.worlds == 1 ? "world" : "worlds", scene.warmup, scene.frames,
          1e3 * scene.base().floor_rms) +
      bands_text(scene.base().floor_bands) + ".";
  io::html::TextTable table{"Cases",
                            {"case", "coverage", "hit rate", "mean accepted error", "largest", "drift [mm]",
                             "defect [mm]", "< 1 cm/1-10/10-100/> 100 cm/inf or NaN", "islands", ""},
                            {}};
  for (const PredictionRun& run : scene.runs) {
    const HitCounts hits = run.all();
    table.rows.push_back(
        {run.name, cell(hits.coverage(), "%.1f %%", 100), cell(hits.hit_rate(), "%.1f %%", 100),
         cell(hits.mean_error(), "%.2g", 1), hits.fuzzy > 0 ? format("%.2g", hits.error_max) : "-",
         run.errors_known ? format("%.3g", 1e3 * run.drift_rms) : "-",
         run.errors_known ? format("%.3g", 1e3 * run.defect_rms) : "-",
         run.errors_known ? bands_text(run.drift_bands) : "-", cell(run.islands, "%.1f", 1), fate_text(run)});
  }
  section.tables = {std::move(table)};
  return section;
}

}  // namespace

void write_prediction_page(const std::string& path, const io::TableFile& file, const PredictionStudy& study,
                           const std::string& file_path) {
  io::html::ChartPage page;
  page.title = "Value prediction";
  page.subtitle = file.attributes.at("command_line");
  page.provenance = io::html::provenance_of(file_path, file, version_line("pbreport"));
  io::html::PageSection overview;
  overview.title = "Figure 8 on the modelled processor";
  overview.text = format(
      "Table 3 at 3 GHz; a frame is satisfied within %.3g ms. A bar is missing where no measured frame was "
      "left.",
      1e3 * study.budget_s);
  overview.charts = {bars(study, &FrameRate::hz, 1, "Frame rate", "Hz", "logarithmic"),
                     bars(study, &FrameRate::satisfied, 100, "Frames satisfied", "%", "linear")};
  overview.tables = {verdicts(study), engines(study)};
  if (!study.sensitivity.empty()) overview.tables.push_back(sensitivity(study));
  page.sections.push_back(std::move(overview));
  for (const PredictionScene& scene : study.scenes) page.sections.push_back(section_of(scene));
  io::html::write_chart_page(path, page);
}

}  // namespace pbmpi::app
