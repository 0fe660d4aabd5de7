#include "app/pbreport/engines/engines_text.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "app/common/format.h"
#include "app/common/json_text.h"
#include "app/pbreport/tables/text_cells.h"
#include "stepping/names.h"

namespace pbmpi::app {
namespace {

using Json = nlohmann::ordered_json;
using stability::Verdict;

constexpr std::size_t most_names = 4;  ///< scenes listed in a cell

std::string millimetres(double length_m) {
  return std::isnan(length_m) ? "-" : format("%.3g", 1e3 * length_m);
}

/// "6 pass, 1 degraded"; "-" without any.
std::string counts_text(const VerdictCounts& counts) {
  std::string text;
  for (std::size_t verdict = 0; verdict < counts.size(); ++verdict) {
    if (counts[verdict] == 0) continue;
    text += format("%s%d %s", text.empty() ? "" : ", ", counts[verdict],
                   std::string(stability::verdict_names[verdict]).c_str());
  }
  return text.empty() ? "-" : text;
}

std::string scenes_text(const std::vector<std::string>& scenes) {
  std::string text;
  for (std::size_t i = 0; i < std::min(scenes.size(), most_names); ++i)
    text += (i == 0 ? "" : ", ") + scenes[i];
  return scenes.size() <= most_names ? text : text + format(" and %zu more", scenes.size() - most_names);
}

std::vector<EnginesTable> tables_of(const EnginesReport& report) {
  std::vector<EnginesTable> tables;
  for (const SceneOfEngines& scene : report.scenes) {
    if (scene.has_own_solutions()) tables.push_back(own_table(scene));
    for (const Yardstick yardstick : scene.yardsticks()) tables.push_back(front_table(scene, yardstick));
  }
  if (!report.settings.empty()) tables.push_back(verdict_table(report));
  tables.push_back(difference_table(report));
  tables.push_back(version_table(report));
  return tables;
}

Json setting_json(const StudyCase& one) {
  return {{"setting", setting_text(one)},
          {"frame_time_s", {{"worst", one.time_s}, {"median", one.median_time_s}}},
          {"common_error_m", finite_or_null(error_m(one, Yardstick::common))},
          {"own_error_m", finite_or_null(error_m(one, Yardstick::own))},
          {"joint_gap_m", finite_or_null(one.joint_gap_m)},
          {"penetration_m", finite_or_null(one.penetration_m)}};
}

Json engine_json(const EngineOfScene& engine) {
  Json json = {{"engine", stepping::name_of(engine.kind)},
               {"settings", engine.cases.settings.size()},
               {"not_finite", engine.not_finite},
               {"felled", engine.felled},
               {"own_solution",
                {{"from_common_reference_m", finite_or_null(engine.law_m)},
                 {"from_fewer_iterations_m", finite_or_null(engine.fewer_m)},
                 {"noise_m", finite_or_null(engine.floor_m)}}}};
  for (const auto& [name, yardstick] :
       {std::pair("common_front", Yardstick::common), std::pair("own_front", Yardstick::own)}) {
    json[name] = Json::array();
    for (const std::size_t setting : engine.front(yardstick))
      json[name].push_back(setting_json(engine.cases.settings[setting]));
  }
  return json;
}

Json counts_json(const VerdictCounts& counts) {
  Json json;
  for (std::size_t verdict = 0; verdict < counts.size(); ++verdict)
    json[std::string(stability::verdict_names[verdict])] = counts[verdict];
  return json;
}

Json verdicts_json(const SettingVerdicts& setting, const std::vector<std::string>& groups) {
  Json json = {{"setting", setting.setting},
               {"engine", stepping::name_of(setting.kind)},
               {"all", counts_json(setting.all)}};
  for (std::size_t group = 0; group < groups.size(); ++group)
    json["groups"][groups[group]] = counts_json(setting.groups[group]);
  return json;
}

}  // namespace

std::string name_of(Yardstick yardstick) {
  return yardstick == Yardstick::common ? "the common reference" : "its own solution";
}

EnginesTable front_table(const SceneOfEngines& scene, Yardstick yardstick) {
  EnginesTable table{
      scene.name + ": error against " + name_of(yardstick) + ", and time",
      yardstick == Yardstick::common
          ? format("Each engine's front; the reference is known to %.3g mm.", 1e3 * scene.uncertainty_m)
          : "Each engine's front; errors of two engines are not to be compared here.",
      {{"engine", "setting (substeps x iterations)", "worst frame [ms]", "error rms [mm]", "joint gap [mm]",
        "depth [mm]"}}};
  for (const EngineOfScene& engine : scene.engines) {
    const std::string name(stepping::name_of(engine.kind));
    const std::vector<std::size_t> front = engine.front(yardstick);
    for (const std::size_t i : front) {
      const StudyCase& one = engine.cases.settings[i];
      table.rows.push_back({name, format("%.3g", 1e3 * one.time_s), millimetres(error_m(one, yardstick)),
                            millimetres(one.joint_gap_m), millimetres(one.penetration_m), setting_text(one)});
    }
    if (front.empty())
      table.rows.push_back({name, "-", "-", "-", "-", "none that stays finite and holds the scene at rest"});
  }
  return table;
}

EnginesTable own_table(const SceneOfEngines& scene) {
  EnginesTable table{scene.name + ": own solutions",
                     format("%d %s, %d measured frames. Of each engine with its usual settings and many "
                            "iterations, errors after a frame, rms.",
                            scene.worlds, scene.worlds == 1 ? "world" : "worlds", scene.frames),
                     {{"engine", "settings", "not finite", "fell at rest", "from the common reference [mm]",
                       "from itself with fewer iterations [mm]", "noise [mm]"}}};
  for (const EngineOfScene& engine : scene.engines)
    table.rows.push_back({std::string(stepping::name_of(engine.kind)),
                          std::to_string(engine.cases.settings.size()), std::to_string(engine.not_finite),
                          std::to_string(engine.felled), millimetres(engine.law_m),
                          millimetres(engine.fewer_m), millimetres(engine.floor_m)});
  return table;
}

EnginesTable verdict_table(const EnginesReport& report) {
  EnginesTable table{"Hard cases", "How many of each group a setting holds.", {{"engine", "setting"}}};
  for (const std::string& group : report.groups) table.rows.front().push_back(group);
  table.rows.front().emplace_back("all");
  for (const SettingVerdicts& setting : report.settings) {
    std::vector<std::string> row = {std::string(stepping::name_of(setting.kind)), setting.setting};
    for (const VerdictCounts& counts : setting.groups) row.push_back(counts_text(counts));
    row.push_back(counts_text(setting.all));
    table.rows.push_back(std::move(row));
  }
  return table;
}

EnginesTable difference_table(const EnginesReport& report) {
  EnginesTable table{"What an engine cannot express, or takes otherwise", "", {{"engine", "in", "what"}}};
  for (const std::string& engine : report.unknown)
    table.rows.push_back({engine, "-", "unknown: this build of pbreport lacks the engine"});
  for (const Difference& one : report.differences)
    table.rows.push_back({std::string(stepping::name_of(one.kind)), scenes_text(one.scenes), one.text});
  if (table.rows.size() == 1) table.rows.push_back({"all", "-", "nothing"});
  return table;
}

EnginesTable version_table(const EnginesReport& report) {
  EnginesTable table{"Versions and settings", "", {{"study", "what", "which"}}};
  for (const StudySource& source : report.sources) {
    table.rows.push_back({source.file, "command", source.command_line});
    for (const auto& [what, version] : source.versions) table.rows.push_back({source.file, what, version});
  }
  return table;
}

std::string engines_to_text(const EnginesReport& report) {
  std::string text;
  for (const EnginesTable& table : tables_of(report)) {
    text += (text.empty() ? "" : "\n") + table.title + "\n";
    if (!table.text.empty()) text += table.text + "\n";
    text += aligned(table.rows);
  }
  text += "\nWhat is not comparable\n";
  for (const std::string& paragraph : not_comparable()) text += paragraph + "\n";
  return text;
}

std::string engines_to_markdown(const EnginesReport& report) {
  std::string text;
  for (const EnginesTable& table : tables_of(report)) {
    text += (text.empty() ? "" : "\n") + ("### " + table.title) + "\n\n";
    if (!table.text.empty()) text += table.text + "\n\n";
    text += markdown(table.rows);
  }
  text += "\n### What is not comparable\n\n";
  for (const std::string& paragraph : not_comparable()) text += "- " + paragraph + "\n";
  return text;
}

std::string engines_to_json(const EnginesReport& report) {
  Json json;
  json["studies"] = Json::array();
  for (const StudySource& source : report.sources) {
    Json one = {{"file", source.file}, {"command_line", source.command_line}};
    for (const auto& [what, version] : source.versions) one["versions"][what] = version;
    json["studies"].push_back(std::move(one));
  }
  json["scenes"] = Json::array();
  for (const SceneOfEngines& scene : report.scenes) {
    Json one = {{"scene", scene.name},
                {"worlds", scene.worlds},
                {"frames", scene.frames},
                {"reference_uncertainty_m", scene.uncertainty_m}};
    one["engines"] = Json::array();
    for (const EngineOfScene& engine : scene.engines) one["engines"].push_back(engine_json(engine));
    json["scenes"].push_back(std::move(one));
  }
  json["hard_cases"] = Json::array();
  for (const SettingVerdicts& setting : report.settings)
    json["hard_cases"].push_back(verdicts_json(setting, report.groups));
  json["differences"] = Json::array();
  for (const Difference& one : report.differences)
    json["differences"].push_back(
        {{"engine", stepping::name_of(one.kind)}, {"text", one.text}, {"scenes", one.scenes}});
  json["unknown_engines"] = report.unknown;
  json["not_comparable"] = not_comparable();
  return json_text(json, 2) + "\n";
}

}  // namespace pbmpi::app
