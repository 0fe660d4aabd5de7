#include "app/pbreport/stability/stability_text.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "analysis/error_bands.h"
#include "app/common/format.h"
#include "app/common/json_text.h"

namespace pbmpi::app {
namespace {

using Json = nlohmann::ordered_json;
using stability::Verdict;

std::string scene_text(const StabilityScene& scene) {
  std::string text = format("\n%s (row %d, %d %s, %g s): %s\n", scene.name.c_str(), scene.row, scene.bodies,
                            scene.bodies == 1 ? "body" : "bodies", scene.seconds, scene.oracle.c_str());
  for (const StabilityCell& cell : scene.cells) {
    const std::string decided =
        cell.judged.verdict == Verdict::not_applicable ? cell.judged.decided_by : decided_text(cell);
    text += format("  %-52s %-8s %s", cell.setting.c_str(), std::string(name_of(cell.judged.verdict)).c_str(),
                   decided.c_str());
    if (std::isfinite(cell.judged.limits.right))
      text += format(" (right up to %.3g, broken beyond %.3g)", cell.judged.limits.right,
                     cell.judged.limits.broken);
    text += "\n";
  }
  return text;
}

std::string counts_text(const StabilityMap& map) {
  std::string text = format("%-54s %5s %9s %7s %5s\n", "setting", "pass", "degraded", "broken", "n/a");
  for (std::size_t k = 0; k < map.settings.size(); ++k) {
    const auto count = count_verdicts(map, k);
    text +=
        format("%-54s %5d %9d %7d %5d\n", map.settings[k].c_str(), count[0], count[1], count[2], count[3]);
  }
  return text;
}

Json cell_json(const StabilityCell& cell) {
  Json json = {{"setting", cell.setting},
               {"dt_s", cell.dt_s},
               {"verdict", name_of(cell.judged.verdict)},
               {"decided_by", cell.judged.decided_by},
               {"value", finite_or_null(cell.judged.value)},
               {"unit", cell.judged.unit},
               {"right_up_to", finite_or_null(cell.judged.limits.right)},
               {"broken_beyond", finite_or_null(cell.judged.limits.broken)},
               {"broken_at_s", finite_or_null(cell.broken_at_s)},
               {"simulated_s", cell.simulated_s},
               {"row_visits", cell.row_visits},
               {"step_time_s", cell.step_time_s},
               {"drift_category", analysis::position_band_names[static_cast<std::size_t>(cell.drift_band)]}};
  Json& metrics = json["metrics"];
  for (std::size_t m = 0; m < stability::num_metrics; ++m)
    metrics[std::string(stability::metric_table[m].name)] = finite_or_null(cell.metrics[m]);
  return json;
}

std::string markdown_line(const std::vector<std::string>& cells) {
  std::string text = "|";
  for (const std::string& cell : cells) text += " " + cell + " |";
  return text + "\n";
}

/// A case's name without the part that all share.
std::string short_name(const std::string& name) {
  const std::size_t slash = name.find('/');
  return slash == std::string::npos ? name : name.substr(slash + 1);
}

std::string markdown_cell(const StabilityCell& cell) {
  switch (cell.judged.verdict) {
    case Verdict::pass:
      return "ok";
    case Verdict::degraded:
      return decided_text(cell);
    case Verdict::broken:
      return "**" + decided_text(cell) + "**";
    case Verdict::not_applicable:
      return "-";
  }
  return {};
}

}  // namespace

std::string stability_to_text(const StabilityMap& map) {
  std::string text = format("study: stability; %zu cases, each judged by the bounds in its scene file\n\n",
                            map.scenes.size());
  text += counts_text(map);
  for (const StabilityScene& scene : map.scenes) text += scene_text(scene);
  return text;
}

std::string stability_to_json(const StabilityMap& map) {
  Json json;
  json["settings"] = map.settings;
  json["cases"] = Json::array();
  for (const StabilityScene& scene : map.scenes) {
    Json one = {{"scene", scene.name},     {"group", scene.group},   {"row", scene.row},
                {"oracle", scene.oracle},  {"source", scene.source}, {"bodies", scene.bodies},
                {"seconds", scene.seconds}};
    one["results"] = Json::array();
    for (const StabilityCell& cell : scene.cells) one["results"].push_back(cell_json(cell));
    json["cases"].push_back(std::move(one));
  }
  return json_text(json, 2) + "\n";
}

std::string stability_to_markdown(const StabilityMap& map) {
  std::vector<std::string> head = {"row", "case"}, rule = {"---", "---"};
  for (const std::string& setting : map.settings) {
    head.push_back(setting);
    rule.emplace_back("---");
  }
  std::string text = markdown_line(head) + markdown_line(rule);
  for (const StabilityScene& scene : map.scenes) {
    std::vector<std::string> line = {std::to_string(scene.row), "`" + short_name(scene.name) + "`"};
    for (const StabilityCell& cell : scene.cells) line.push_back(markdown_cell(cell));
    text += markdown_line(line);
  }
  for (const Verdict verdict : {Verdict::pass, Verdict::degraded, Verdict::broken, Verdict::not_applicable}) {
    std::vector<std::string> line = {"", std::string(name_of(verdict))};
    for (std::size_t k = 0; k < map.settings.size(); ++k)
      line.push_back(std::to_string(count_verdicts(map, k)[static_cast<std::size_t>(verdict)]));
    text += markdown_line(line);
  }
  return text;
}

}  // namespace pbmpi::app
