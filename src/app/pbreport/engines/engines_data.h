/// Studies read back engine by engine.
#pragma once

#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/pbreport/accuracy/study_data.h"
#include "app/pbreport/engines/engines_options.h"
#include "app/pbreport/stability/stability_data.h"
#include "io/html/provenance.h"

namespace pbmpi::app {

/// Errors by which an engine's settings are ranked: against the common reference, and against the engine's
/// own solution. They answer different questions and are never mixed.
enum class Yardstick { common, own };

/// rms of body positions after one frame [m]; infinite for a setting that blew up or lets bodies fall at
/// rest, and where the study has no own solution.
double error_m(const StudyCase& one, Yardstick yardstick);

/// An engine in a scene.
struct EngineOfScene {
  stepping::StepperKind kind = stepping::StepperKind::sor;
  SceneCases cases;                ///< its settings alone
  int not_finite = 0, felled = 0;  ///< settings that blew up; that let bodies fall at rest
  /// For the engine's solution with its usual settings [m], rms: its distance from the common reference (by
  /// what its model differs), from itself with fewer iterations, and from itself begun in disturbed states
  /// with another seed (its noise). NaN where the study has none.
  double law_m = NAN, fewer_m = NAN, floor_m = NAN;

  /// Indices of settings, by ascending time; empty if none stands.
  std::vector<std::size_t> front(Yardstick yardstick) const;
};

/// A scene of a study of accuracy.
struct SceneOfEngines {
  std::string name;
  int worlds = 1, frames = 0;
  double uncertainty_m = 0;  ///< of the common reference
  std::vector<EngineOfScene> engines = {};

  bool has_own_solutions() const;
  /// The yardsticks for which the study has errors.
  std::vector<Yardstick> yardsticks() const;
};

/// Results of a setting in a group of hard cases: number of cases with each verdict.
using VerdictCounts = std::array<int, stability::verdict_names.size()>;
struct SettingVerdicts {
  std::string setting;
  stepping::StepperKind kind = stepping::StepperKind::sor;
  std::vector<VerdictCounts> groups = {};  ///< in the order of EnginesReport::groups
  VerdictCounts all{};
};

/// Something that an engine treats differently from ODE, and in how many scenes and cases.
struct Difference {
  stepping::StepperKind kind = stepping::StepperKind::bullet;
  std::string text;
  std::vector<std::string> scenes;  ///< of the studies, in their order
};

/// A study's origin, shown beside its name in a report.
struct StudySource {
  std::string file, command_line;
  std::vector<std::pair<std::string, std::string>> versions;  ///< of pbmpi, its build, the engines
};

struct EnginesReport {
  io::html::Provenance provenance;  ///< of the first study
  std::vector<StudySource> sources;
  std::vector<SceneOfEngines> scenes;
  std::vector<std::string> groups;  ///< of hard cases
  std::vector<SettingVerdicts> settings;
  std::optional<StabilityMap> map;
  std::vector<Difference> differences;
  /// Steppers of the studies whose engine this build of pbreport lacks, so that their differences are
  /// unknown.
  std::vector<std::string> unknown;
};

/// Throws core::InputError for files that cannot be read, and for a scene that is not there.
EnginesReport read_engines(const EnginesOptions& options);

/// Differences that no setting removes, one paragraph each.
std::vector<std::string> not_comparable();

}  // namespace pbmpi::app
