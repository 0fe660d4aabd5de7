/// The cases of "pbstudy accuracy": pure data, the same on every rank.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "app/pbstudy/accuracy/accuracy_options.h"
#include "app/pbstudy/study/study_scene.h"

namespace pbmpi::app {

/// Why a case is there.
enum class CaseKind {
  setting,   ///< one setting of the matrix
  nature,    ///< what all are compared with: how far it is known, and at what cost
  estimate,  ///< FEEC: what a frame of the setting shows before it has ended
  own,       ///< the equations of one stepper's settings, solved by that stepper itself with many iterations
  own_floor  ///< own, from disturbed states with another solver seed: the engine's noise
};
inline constexpr std::array<std::string_view, 5> case_kind_names = {"setting", "nature", "estimate", "own",
                                                                    "own_floor"};
constexpr bool is_own(CaseKind kind) { return kind == CaseKind::own || kind == CaseKind::own_floor; }

struct AccuracyCase {
  static constexpr int no_own = -1;

  int scene = 0;  ///< index into the study's scenes
  CaseKind kind = CaseKind::setting;
  stepping::StepperSettings stepper;
  int steps_per_frame = 3;
  std::optional<stepping::StepperSettings> estimate = {};  ///< for CaseKind::estimate
  /// For a setting and for is_own(): the case that solves the same equations; otherwise no_own.
  int own = no_own;

  int sweeps() const { return sweeps_of(stepper); }  ///< in a step
  int sweeps_a_frame() const;                        ///< until the estimate, or the frame's end, is there
};

/// The settings that solve the equations of `setting` with so many iterations a step, in double precision and
/// without a tolerance. Substeps share the iterations; the soft law has as many relaxing sweeps. A stepper
/// without iterations keeps its settings.
stepping::StepperSettings own_settings(const stepping::StepperSettings& setting, int iterations);

/// All cases of all scenes, scene by scene. Throws core::InputError for a dt that does not fill a frame.
std::vector<AccuracyCase> make_cases(const std::vector<StudyScene>& scenes, const AccuracyOptions& options);

/// Expected, in any unit.
double cost_of(const AccuracyCase& one, const StudyScene& scene);

}  // namespace pbmpi::app
