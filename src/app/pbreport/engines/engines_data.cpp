#include "app/pbreport/engines/engines_data.h"

#include <algorithm>
#include <limits>

#include "app/common/options.h"
#include "app/common/scene_parameter.h"
#include "app/pbreport/study/case_row.h"
#include "app/pbreport/study/study_file.h"
#include "engines/optional_engines.h"
#include "scenes/scene.h"
#include "stepping/names.h"

namespace pbmpi::app {
namespace {

using stepping::StepperKind;

/// Appends the value, unless the list has it already.
template <class Value>
void add_new(const Value& value, std::vector<Value>& list) {
  if (std::ranges::find(list, value) == list.end()) list.push_back(value);
}

template <class Cases>
void keep_kind(StepperKind kind, Cases& cases) {
  std::erase_if(cases, [kind](const StudyCase& one) { return one.stepper.kind != kind; });
}

EngineOfScene engine_of(const SceneCases& scene, StepperKind kind) {
  EngineOfScene engine{.kind = kind, .cases = scene};
  keep_kind(kind, engine.cases.settings);
  keep_kind(kind, engine.cases.own_floor);
  for (const StudyCase& one : engine.cases.settings) {
    engine.not_finite += one.finite() ? 0 : 1;
    engine.felled += one.fells() ? 1 : 0;
  }
  engine.floor_m = scene.own_floor_m(kind, ErrorMeasure::rms);
  // The own solution whose noise was measured is that of the usual settings.
  if (engine.cases.own_floor.empty()) return engine;
  const auto usual = std::ranges::find(scene.own, engine.cases.own_floor.front().own, &StudyCase::own);
  if (usual == scene.own.end()) return engine;
  engine.law_m = usual->error_m(ErrorMeasure::rms);
  if (stepping::traits_of(kind).iterates) engine.fewer_m = usual->own_error_m(ErrorMeasure::rms);
  return engine;
}

SceneOfEngines scene_of(const SceneCases& scene) {
  SceneOfEngines found{.name = scene.name, .uncertainty_m = scene.uncertainty_m(ErrorMeasure::rms)};
  for (const StudyCase& one : scene.settings) {
    found.worlds = one.worlds;
    found.frames = one.frames;
    if (std::ranges::find(found.engines, one.stepper.kind, &EngineOfScene::kind) == found.engines.end())
      found.engines.push_back(engine_of(scene, one.stepper.kind));
  }
  return found;
}

StudySource source_of(const io::TableFile& file, const std::string& path) {
  StudySource source{path, file.attributes.at("command_line"), {}};
  source.versions.emplace_back(
      "pbmpi", file.attributes.at("pbmpi_version") + " (" + file.attributes.at("git_revision") + ")");
  for (const io::Parameter& parameter : file.parameters) {
    constexpr std::string_view library = "library_";
    if (parameter.name == "build") source.versions.emplace_back(parameter.name, parameter.text);
    if (parameter.name.starts_with(library))
      source.versions.emplace_back(parameter.name.substr(library.size()), parameter.text);
  }
  return source;
}

void add_source(const io::TableFile& file, const std::string& path, EnginesReport& report) {
  if (report.sources.empty())
    report.provenance = io::html::provenance_of(path, file, version_line("pbreport"));
  report.sources.push_back(source_of(file, path));
}

/// The settings of a study of stability, in its order.
std::vector<SettingVerdicts> settings_of(const io::TableFile& file, const StabilityMap& map,
                                         const std::vector<std::string>& groups) {
  std::vector<SettingVerdicts> settings;
  for (std::size_t i = 0; i < map.settings.size(); ++i) {
    SettingVerdicts setting{.setting = map.settings[i]};
    setting.groups.resize(groups.size());
    for (const StabilityScene& scene : map.scenes) {
      const StabilityCell& cell = scene.cells[i];
      setting.kind = CaseRow(file, cell.index).step_settings().kind;
      const auto verdict = static_cast<std::size_t>(cell.judged.verdict);
      const auto group = std::ranges::find(groups, scene.group) - groups.begin();
      ++setting.groups[static_cast<std::size_t>(group)][verdict];
      ++setting.all[verdict];
    }
    settings.push_back(std::move(setting));
  }
  return settings;
}

/// Adds the parts that each engine treats differently, for the scenes whose texts the file has.
void add_differences(const io::TableFile& file, const std::vector<std::string>& scenes,
                     const std::vector<StepperKind>& kinds, std::vector<Difference>& differences) {
  for (const std::string& name : scenes) {
    const scenes::SceneSource source{name, name + ".toml",
                                     text_parameter(file, scene_text_parameter(name), "")};
    const auto model = scenes::parse_scene(source)->build(0, 1);
    for (const StepperKind kind : kinds) {
      for (const std::string& text : engines::inexpressible(kind, *model)) {
        auto known = std::ranges::find_if(
            differences, [&](const Difference& one) { return one.kind == kind && one.text == text; });
        if (known == differences.end()) known = differences.insert(known, {kind, text, {}});
        add_new(name, known->scenes);
      }
    }
  }
  std::ranges::stable_sort(differences, {}, &Difference::kind);
}

void note_unknown(const std::vector<StepperKind>& kinds, std::vector<std::string>& unknown) {
  for (const StepperKind kind : kinds) {
    const engines::OptionalEngine* engine = engines::find_optional_engine(kind);
    if (engine != nullptr && !engine->in_build()) add_new(std::string(name_of(kind)), unknown);
  }
}

void read_accuracy(const EnginesOptions& options, EnginesReport& report) {
  const io::TableFile file = read_study(*options.accuracy, "accuracy");
  add_source(file, *options.accuracy, report);
  std::vector<std::string> names;
  std::vector<StepperKind> kinds;
  for (const SceneCases& scene : study_scenes(file, options.scenes)) {
    report.scenes.push_back(scene_of(scene));
    names.push_back(scene.name);
    for (const EngineOfScene& engine : report.scenes.back().engines) add_new(engine.kind, kinds);
  }
  add_differences(file, names, kinds, report.differences);
  note_unknown(kinds, report.unknown);
}

void read_stability(const EnginesOptions& options, EnginesReport& report) {
  const io::TableFile file = read_study(*options.stability, "stability");
  add_source(file, *options.stability, report);
  report.map = stability_map(file, {});
  std::vector<std::string> names;
  std::vector<StepperKind> kinds;
  for (const StabilityScene& scene : report.map->scenes) {
    names.push_back(scene.name);
    add_new(scene.group, report.groups);
  }
  report.settings = settings_of(file, *report.map, report.groups);
  for (const SettingVerdicts& setting : report.settings) add_new(setting.kind, kinds);
  add_differences(file, names, kinds, report.differences);
  note_unknown(kinds, report.unknown);
}

}  // namespace

double error_m(const StudyCase& one, Yardstick yardstick) {
  constexpr double none = std::numeric_limits<double>::infinity();
  if (!one.finite() || one.fells()) return none;
  if (yardstick == Yardstick::common) return one.error_m(ErrorMeasure::rms);
  return one.has_own() ? one.own_error_m(ErrorMeasure::rms) : none;
}

std::vector<std::size_t> EngineOfScene::front(Yardstick yardstick) const {
  return cases.pareto_front([yardstick](const StudyCase& one) { return error_m(one, yardstick); });
}

bool SceneOfEngines::has_own_solutions() const {
  return std::ranges::any_of(engines, [](const EngineOfScene& engine) {
    return std::ranges::any_of(engine.cases.settings, &StudyCase::has_own);
  });
}

std::vector<Yardstick> SceneOfEngines::yardsticks() const {
  if (!has_own_solutions()) return {Yardstick::common};
  return {Yardstick::common, Yardstick::own};
}

EnginesReport read_engines(const EnginesOptions& options) {
  EnginesReport report;
  if (options.accuracy) read_accuracy(options, report);
  if (options.stability) read_stability(options, report);
  return report;
}

std::vector<std::string> not_comparable() {
  return {
      "Contacts: each engine finds them by its own collision detection, so that points, numbers and depths "
      "differ before "
      "a solver begins. The common reference is a cold sor with the contacts of sor: its error flatters sor, "
      "and is "
      "what an engine loses by its solver and by its contacts together. The own solution has the engine's "
      "contacts.",
      "Laws: MuJoCo's contacts are soft by a law of its own, and its joints are coordinates of a tree that "
      "cannot open; "
      "the others have rows for joints, which open by what the solver leaves. A joint gap of nothing is no "
      "merit of "
      "MuJoCo's solver, as contacts that give are no fault of it. quick, direct and bullet bound friction by "
      "a pyramid of "
      "two directions, sor by default and mujoco by a cone.",
      "Memory: quick, direct and bullet begin each step from nothing, here also mujoco, so that a state "
      "restores a world; "
      "sor keeps its memory in the state. Bullet and MuJoCo in a program of their own would begin with their "
      "last forces.",
      "Steps: all engines are given the step of the scene. MuJoCo divides it into parts of 2.5 ms at most, "
      "sor into "
      "substeps with one collision detection.",
      "Times: processor time on one core, of all worlds of the scene and of the worst measured frame. sor "
      "steps worlds side by side in "
      "vector lanes, the others one after the other; of one world much of the lanes is idle.",
  };
}

}  // namespace pbmpi::app
