#include "app/pbreport/stability/stability_data.h"

#include <algorithm>
#include <cmath>

#include "app/common/format.h"
#include "app/pbreport/study/case_row.h"
#include "model/names.h"

namespace pbmpi::app {
namespace {

using stability::Verdict;

StabilityCell read_cell(const CaseRow& row, std::size_t index) {
  StabilityCell cell;
  cell.index = index;
  cell.setting = row.text("setting");
  cell.dt_s = row.real("dt");
  const auto verdict = model::enum_from_name<Verdict>(row.text("verdict"), stability::verdict_names);
  cell.judged.verdict = verdict.value_or(Verdict::not_applicable);
  cell.judged.decided_by = row.text("decided_by");
  cell.judged.value = row.real("value");
  cell.judged.limits = {row.real("limit_right"), row.real("limit_broken")};
  cell.judged.unit = row.text("value_unit");
  for (std::size_t m = 0; m < stability::num_metrics; ++m)
    cell.metrics[m] = row.real(std::string(stability::metric_table[m].name));
  cell.broken_at_s = row.real("broken_at");
  cell.simulated_s = row.real("simulated");
  cell.row_visits = row.real("row_visits");
  cell.step_time_s = row.real("step_time");
  cell.drift_band = row.integer("drift_band");
  return cell;
}

StabilityScene read_scene(const CaseRow& row) {
  StabilityScene scene;
  scene.name = row.text("scene");
  scene.group = row.text("group");
  scene.oracle = row.text("oracle");
  scene.source = row.text("source");
  scene.row = row.integer("row");
  scene.bodies = row.integer("bodies");
  scene.seconds = row.real("seconds");
  return scene;
}

/// "1.2 mm" rather than 0.0012 m.
std::string with_unit(double value, const std::string& unit) {
  const bool is_length = unit == "m" || unit == "m/s";
  if (is_length && std::abs(value) < 1) return format("%.3g m%s", 1e3 * value, unit.c_str());
  return format("%.3g%s%s", value, unit.empty() ? "" : " ", unit.c_str());
}

}  // namespace

StabilityMap stability_map(const io::TableFile& file, const std::vector<std::string>& names) {
  StabilityMap map;
  const std::size_t num_cases = file.column<std::string>("cases", "scene").size();
  for (std::size_t i = 0; i < num_cases; ++i) {
    const CaseRow row(file, i);
    const StabilityCell cell = read_cell(row, i);
    auto scene = std::ranges::find(map.scenes, row.text("scene"), &StabilityScene::name);
    if (scene == map.scenes.end()) scene = map.scenes.insert(scene, read_scene(row));
    scene->cells.push_back(cell);
    if (std::ranges::find(map.settings, cell.setting) == map.settings.end())
      map.settings.push_back(cell.setting);
  }
  map.scenes = chosen_scenes(map.scenes, names);
  return map;
}

std::array<int, stability::verdict_names.size()> count_verdicts(const StabilityMap& map,
                                                                std::size_t setting) {
  std::array<int, stability::verdict_names.size()> count{};
  for (const StabilityScene& scene : map.scenes)
    ++count[static_cast<std::size_t>(scene.cells[setting].judged.verdict)];
  return count;
}

std::string_view name_of(stability::Verdict verdict) {
  return stability::verdict_names[static_cast<std::size_t>(verdict)];
}

std::string decided_text(const StabilityCell& cell) {
  if (cell.judged.verdict == Verdict::not_applicable) return {};
  std::string text = cell.judged.decided_by + " " + with_unit(cell.judged.value, cell.judged.unit);
  if (cell.judged.verdict == Verdict::broken && std::isfinite(cell.broken_at_s))
    text += format(" at %.3g s", cell.broken_at_s);
  return text;
}

}  // namespace pbmpi::app
