/// The cases of "pbstudy accuracy": pure data, the same on every rank.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "app/common/estimate_spec.h"
#include "app/pbstudy/accuracy/accuracy_options.h"
#include "app/pbstudy/accuracy/reference.h"
#include "app/pbstudy/study/study_scene.h"

namespace pbmpi::app {

/// Why a case is there.
enum class CaseKind {
  setting,          ///< one of the matrix
  reference,        ///< itself: how far it was solved, and what that took
  floor,            ///< the reference with another solver seed: what noise alone does
  more_iterations,  ///< each of its steps with many times as many iterations: has it converged?
  second_method,    ///< its frames by ODE, with contact points and a solver of its own
  halved_dt,        ///< the reference with half the step: what the step's length does, which no solver mends
  estimate,         ///< FEEC: what a frame of the setting shows before it has ended
};
inline constexpr std::array<std::string_view, 7> case_kind_names = {
    "setting", "reference", "floor", "more_iterations", "second_method", "halved_dt", "estimate"};
/// Is it there to judge the reference?
constexpr bool is_yardstick(CaseKind kind) { return kind != CaseKind::setting && kind != CaseKind::estimate; }

struct AccuracyCase {
  int scene = 0;  ///< index into the study's scenes
  CaseKind kind = CaseKind::setting;
  stepping::StepperSettings stepper;
  int steps_per_frame = 3;
  std::optional<EstimateSpec> estimate = {};  ///< of CaseKind::estimate

  int sweeps() const { return sweeps_of(stepper); }  ///< in a step
  int sweeps_a_frame() const;                        ///< until what it shows is there
};

StudyScene study_scene(const scenes::SceneSource& source, const AccuracyOptions& options);

/// The setting of the reference: a cold sor in double precision, with the iterations that it begins with.
stepping::StepperSettings reference_settings(const StudyScene& scene, const AccuracyOptions& options);
ReferenceSolve reference_solve(const StudyScene& scene, const AccuracyOptions& options);

/// All cases of all scenes, scene by scene. Throws core::InputError for a dt that does not fill a frame.
std::vector<AccuracyCase> make_cases(const std::vector<StudyScene>& scenes, const AccuracyOptions& options);

/// Which rank works on which case [num_cases]: by expected cost, the dearest first.
std::vector<int> deal_out(const std::vector<AccuracyCase>& cases, const std::vector<StudyScene>& scenes,
                          int num_ranks);

}  // namespace pbmpi::app
