#include "app/pbreport/effects/effects_page.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "app/common/format.h"
#include "app/common/json_text.h"
#include "app/common/options.h"
#include "app/pbreport/effects/effects_text.h"
#include "app/pbreport/study/error_text.h"
#include "io/html/chart_page.h"

namespace pbmpi::app {
namespace {

using ChartJson = nlohmann::json;

/// A colour for each scene: Okabe and Ito, "Color Universal Design" (2008), and a grey.
constexpr std::array<const char*, 9> colours = {"#0072b2", "#e69f00", "#009e73", "#cc79a7", "#d55e00",
                                                "#56b4e9", "#f0e442", "#000000", "#999999"};

/// The number that a chart shows for a row; none = no bar.
using Value = std::optional<double> (*)(const EffectRow&);

std::optional<double> share_of_left_out(const EffectRow& row) {
  if (!row.measured() || row.demanded()) return std::nullopt;
  return 100 * row.share.median;
}
std::optional<double> share_of_demanded(const EffectRow& row) {
  if (!row.measured() || !row.demanded()) return std::nullopt;
  return 100 * row.share.median;
}
std::optional<double> counted_share(const EffectRow& row) {
  const auto share = row.instruction_share();
  return share ? std::optional<double>(100 * *share) : std::nullopt;
}
std::optional<double> defect_mm(const EffectRow& row) {
  if (!row.measured() || row.same_bits.value()) return std::nullopt;
  return 1e3 * row.defect.body_position.rms;
}

std::vector<std::string> steppers_of(const std::vector<EffectScene>& scenes) {
  std::vector<std::string> names;
  for (const EffectScene& scene : scenes) {
    if (std::find(names.begin(), names.end(), scene.stepper) == names.end()) names.push_back(scene.stepper);
  }
  return names;
}

/// Effects for which some scene has a value, in their order, which is that of each scene.
std::vector<std::string> effects_with(const std::vector<EffectScene>& scenes, Value value) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < scenes.front().effects.size(); ++i) {
    if (std::any_of(scenes.begin(), scenes.end(),
                    [&](const EffectScene& scene) { return value(scene.effects[i]).has_value(); }))
      names.push_back(scenes.front().effects[i].effect);
  }
  return names;
}

/// The band of shares that another solver seed alone seems to cost: the clock's noise.
ChartJson time_noise(const std::vector<EffectScene>& scenes) {
  double share = 0;
  for (const EffectScene& scene : scenes) share = std::max(share, 100 * scene.floor_share());
  return {{{"from", -share},
           {"to", share},
           {"label", "noise floor"},
           {"align", "right"},
           {"colour", "rgba(120, 130, 142, .30)"}}};
}

/// What is drawn behind the bars.
enum class Floor {
  none,
  time,   ///< a band: what another solver seed seems to cost
  error,  ///< separate bars: the change caused by another solver seed
};

/// Bars: one group per effect, one bar per scene.
io::html::Chart bars(const char* title, const char* text, const char* axis, const char* scale,
                     const std::vector<EffectScene>& scenes, Value value, Floor floor) {
  std::vector<std::string> labels = effects_with(scenes, value);
  if (floor == Floor::error) labels.emplace_back("noise floor");
  ChartJson datasets = ChartJson::array();
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    const EffectScene& scene = scenes[i];
    ChartJson points = ChartJson::array();
    const auto add = [&](const std::string& effect, double y) {
      points.push_back({{"x", effect}, {"y", y}, {"label", format("%s: %.3g", scene.name.c_str(), y)}});
    };
    for (const EffectRow& row : scene.effects) {
      if (const auto y = value(row)) add(row.effect, *y);
    }
    if (floor == Floor::error) add("noise floor", 1e3 * scene.floor_defect_m());
    datasets.push_back(
        {{"label", scene.name}, {"data", points}, {"backgroundColor", colours[i % colours.size()]}});
  }
  ChartJson options = {
      {"scales", {{"y", {{"type", scale}, {"title", {{"display", true}, {"text", axis}}}}}}}};
  if (floor == Floor::time) options["plugins"]["pbmpi"]["bands"] = time_noise(scenes);
  const ChartJson config = {
      {"type", "bar"}, {"data", {{"labels", labels}, {"datasets", datasets}}}, {"options", options}};
  return {title, text, json_text(config)};
}

std::string cell_of(const EffectScene& scene, const std::string& effect) {
  for (const EffectRow& row : scene.effects) {
    if (row.effect != effect) continue;
    if (!row.measured()) return "cannot be left out";
    const std::string share = percent_text(row.share.median);
    if (row.demanded()) return "(" + share + (row.same_bits.value() ? ")" : "), other bits");
    return share +
           (row.same_bits.value() ? ", no error" : format(", %.3g mm", 1e3 * row.defect.body_position.rms));
  }
  return "";
}

io::html::TextTable matrix(const std::vector<EffectScene>& scenes) {
  io::html::TextTable table;
  table.title =
      "Share of the step, defect rms if left out; in brackets what demanding costs where the scene has it "
      "not";
  table.header = {"effect"};
  for (const EffectScene& scene : scenes) table.header.push_back(scene.name);
  for (const EffectRow& any : scenes.front().effects) {
    std::vector<std::string> row = {any.effect};
    for (const EffectScene& scene : scenes) row.push_back(cell_of(scene, any.effect));
    table.rows.push_back(std::move(row));
  }
  std::vector<std::string> floor = {"noise floor"};
  for (const EffectScene& scene : scenes)
    floor.push_back(percent_text(scene.floor_share()) + format(", %.3g mm", 1e3 * scene.floor_defect_m()));
  table.rows.push_back(std::move(floor));
  return table;
}

io::html::PageSection overview(const std::string& stepper, const std::vector<EffectScene>& scenes,
                               bool counted) {
  io::html::PageSection section;
  section.title = stepper;
  section.text =
      "Each case does the scene's measured frames with and without an effect, in turn, from the same states. "
      "The "
      "share is what the effect adds, of the time of the step that has it (medians); below zero the scene's "
      "step "
      "is shorter with it.";
  section.charts = {
      bars("Share of the step time", "Effects that the scene has.", "share of the step [%]", "linear", scenes,
           share_of_left_out, Floor::time),
      bars("Error if left out", "Defect of all bodies after one frame, against the scene as it is.",
           "defect, rms [mm]", "logarithmic", scenes, defect_mm, Floor::error),
      bars("Demanded though the scene has it not",
           "What it costs; where nothing calls for it no bit of the result changes.", "share of the step [%]",
           "linear", scenes, share_of_demanded, Floor::time),
  };
  if (counted) {
    section.charts.push_back(
        bars("Share of the instructions", "Fewest of all repeats; no clock disturbs them.",
             "share of the step's instructions [%]", "linear", scenes, counted_share, Floor::none));
  }
  section.tables = {matrix(scenes)};
  return section;
}

std::vector<std::string> detail(const EffectRow& row) {
  if (!row.measured()) return {row.effect, "", "", "", "", "", "", "", note_of(row)};
  const auto counted = row.instruction_share();
  return {row.effect,
          format("%.1f", 1e6 * row.time_with_s.median),
          format("%.2f", 1e6 * row.cost_s.median),
          percent_text(row.share.median) + " (" + percent_text(row.share.p10) + " to " +
              percent_text(row.share.p90) + ")",
          counted ? percent_text(*counted) : "-",
          format("%.4g", 1e3 * row.defect.body_position.rms),
          format("%.4g", 1e3 * row.drift.body_position.rms),
          bands_text(row.drift.body_position.bands, " / "),
          note_of(row)};
}

io::html::PageSection scene_section(const EffectScene& scene) {
  io::html::PageSection section;
  section.title = scene.name + ", " + scene.stepper;
  section.text = format(
      "A step takes %.1f us as the scene is. Noise floor, the largest of %zu other solver seeds: time %s of "
      "a "
      "step, defect rms %.4g mm, drift rms %.4g mm.",
      1e6 * scene.step_s(), scene.floor.size(), percent_text(scene.floor_share()).c_str(),
      1e3 * scene.floor_defect_m(), 1e3 * scene.floor_drift_m());
  io::html::TextTable table;
  table.title = "Effects";
  table.header = {"effect",
                  "step us",
                  "cost us",
                  "of the step (p10 to p90)",
                  "instructions",
                  "defect rms mm",
                  "drift rms mm",
                  "bodies by drift: < 1 cm / 1-10 / 10-100 / > 100 / inf",
                  ""};
  for (const EffectRow& row : scene.effects) table.rows.push_back(detail(row));
  section.tables = {std::move(table)};
  return section;
}

}  // namespace

void write_effects_page(const std::string& path, const io::TableFile& file,
                        const std::vector<EffectScene>& scenes, const ReportOfStudyOptions& options) {
  io::html::ChartPage page;
  page.title = "What effects cost";
  page.subtitle = options.file + "; " + instructions_text(file);
  page.provenance = io::html::provenance_of(options.file, file, version_line("pbreport"));
  for (const std::string& stepper : steppers_of(scenes)) {
    std::vector<EffectScene> of_stepper;
    std::copy_if(scenes.begin(), scenes.end(), std::back_inserter(of_stepper),
                 [&](const EffectScene& scene) { return scene.stepper == stepper; });
    page.sections.push_back(overview(stepper, of_stepper, instructions_by(file) != "none"));
  }
  for (const EffectScene& scene : scenes) page.sections.push_back(scene_section(scene));
  io::html::write_chart_page(path, page);
}

}  // namespace pbmpi::app
