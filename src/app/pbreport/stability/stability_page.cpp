#include "app/pbreport/stability/stability_page.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "app/common/format.h"
#include "app/common/options.h"
#include "app/common/scene_parameter.h"
#include "app/pbreport/study/study_file.h"
#include "io/html/map_page.h"
#include "model/names.h"
#include "scenes/scene.h"

namespace pbmpi::app {
namespace {

using io::html::MapCell;
using stability::Verdict;

/// Rows of a table that belong to each case: [first, last).
class RowsOfCase {
 public:
  RowsOfCase(const io::TableFile& file, const std::string& table) {
    const auto& cases = file.column<std::int64_t>(table, "case");
    for (std::size_t i = 0; i < cases.size(); ++i) {
      auto [range, is_new] = ranges_.try_emplace(static_cast<std::size_t>(cases[i]), i, i);
      range->second.second = i + 1;
    }
  }
  std::pair<std::size_t, std::size_t> operator()(std::size_t index) const {
    const auto found = ranges_.find(index);
    return found == ranges_.end() ? std::pair<std::size_t, std::size_t>{0, 0} : found->second;
  }

 private:
  std::map<std::size_t, std::pair<std::size_t, std::size_t>> ranges_;
};

std::vector<io::html::MapCurve> curves_of(const io::TableFile& file, const RowsOfCase& rows,
                                          std::size_t index) {
  const auto [first, last] = rows(index);
  if (first == last) return {};
  const auto part = [&, from = first, to = last](const char* name) {
    const auto& all = file.column<double>("curves", name);
    return std::vector<double>(all.begin() + static_cast<std::ptrdiff_t>(from),
                               all.begin() + static_cast<std::ptrdiff_t>(to));
  };
  const std::vector<double> time_s = part("time");
  return {{"Energy", "J", time_s, part("energy")},
          {"Joint gap", "m", time_s, part("joint_gap")},
          {"Deepest contact", "m", time_s, part("penetration")},
          {"Drift", "m", time_s, part("drift")}};
}

/// Bodies, geoms and first poses of a scene, for the replay.
io::RunData still_of(const io::TableFile& file, const std::string& scene) {
  const scenes::SceneSource source = {scene, scene + ".toml",
                                      text_parameter(file, scene_text_parameter(scene), "")};
  const auto model = scenes::parse_scene(source)->build(0, 1);
  io::RunData run;
  run.num_worlds = 1;
  for (const model::Body& body : model->bodies) {
    run.bodies.name.push_back(body.name);
    run.bodies.world.push_back(0);
    run.bodies.initial.push_back(body.pose);
  }
  for (const model::Geom& geom : model->geoms) {
    const auto kind = static_cast<std::size_t>(model->actors[static_cast<std::size_t>(geom.actor)].kind);
    run.geoms.push_back({0, geom.body, std::string(model::actor_kind_names[kind]),
                         std::string(model::shape_names[static_cast<std::size_t>(geom.shape)]), geom.size,
                         geom.local});
  }
  return run;
}

void add_poses(const io::TableFile& file, const RowsOfCase& rows, std::size_t index, io::RunData& run) {
  const auto [first, last] = rows(index);
  const auto& time_s = file.column<double>("poses", "time");
  const auto& pose = file.column<double>("poses", "pose");
  const double dt_s = file.column<double>("cases", "dt")[index];
  for (std::size_t i = first; i < last; ++i) {
    if (run.recorded_time_s.empty() || time_s[i] > run.recorded_time_s.back()) {
      run.recorded_time_s.push_back(time_s[i]);
      run.recorded_step.push_back(std::llround(time_s[i] / dt_s));
      run.position.emplace_back();
      run.orientation.emplace_back();
    }
    const double* p = &pose[7 * i];
    run.position.back().emplace_back(p[0], p[1], p[2]);
    run.orientation.back().push_back({p[3], p[4], p[5], p[6]});
  }
}

/// How dark a cell is: 0 for a right number, 1 at a thousand times its limit or more.
double severity(const stability::Judgement& judged) {
  if (judged.verdict == Verdict::pass || judged.verdict == Verdict::not_applicable) return 0;
  if (!(judged.limits.right > 0) || !std::isfinite(judged.value)) return 1;
  return std::clamp(std::log10(judged.value / judged.limits.right) / 3, 0.0, 1.0);
}

std::string detail_of(const StabilityCell& cell) {
  if (cell.judged.verdict == Verdict::not_applicable) return cell.judged.decided_by;
  std::string text = decided_text(cell) + format("; right up to %.3g, broken beyond %.3g.",
                                                 cell.judged.limits.right, cell.judged.limits.broken);
  text += format(" %.0f row visits and %.3g us of processor time a step.", cell.row_visits,
                 1e6 * cell.step_time_s);
  return text;
}

}  // namespace

void write_stability_page(const std::string& path, const io::TableFile& file, const StabilityMap& map,
                          const std::string& file_path) {
  const RowsOfCase curves(file, "curves"), poses(file, "poses");
  io::html::MapPage page;
  page.title = "Stability";
  page.subtitle = format("%zu hard cases, %zu settings; %s", map.scenes.size(), map.settings.size(),
                         file.attributes.at("command_line").c_str());
  page.columns = map.settings;
  page.provenance = io::html::provenance_of(file_path, file, version_line("pbreport"));
  for (const StabilityScene& scene : map.scenes) {
    const io::RunData still = still_of(file, scene.name);
    io::html::MapRow row{scene.name, scene.group, scene.oracle, scene.source, {}};
    for (const StabilityCell& cell : scene.cells) {
      MapCell field;
      field.verdict = name_of(cell.judged.verdict);
      field.label = cell.judged.verdict == Verdict::pass ? "" : decided_text(cell);
      field.severity = severity(cell.judged);
      field.detail = detail_of(cell);
      field.curves = curves_of(file, curves, cell.index);
      field.replay = still;
      add_poses(file, poses, cell.index, field.replay);
      row.cells.push_back(std::move(field));
    }
    page.rows.push_back(std::move(row));
  }
  write_map_page(path, page);
}

}  // namespace pbmpi::app
