/// The cases of "pbstudy accuracy": pure data, the same on every rank.
#pragma once

#include <string_view>
#include <vector>

#include "app/pbstudy/accuracy/accuracy_options.h"
#include "app/pbstudy/study/study_scene.h"

namespace pbmpi::app {

/// Why a case is there.
enum class CaseKind {
  setting,            ///< one of the matrix
  floor,              ///< the reference with another solver seed: what noise alone does
  halved_iterations,  ///< the reference with half its iterations: is it converged?
  halved_substeps,    ///< the same for its substeps, if it has several
  halved_dt,  ///< the reference with half the step: what the step's length does, which no solver mends
  estimate,   ///< FEEC: what a frame of the setting shows before its last solve has ended
};
inline constexpr std::array<std::string_view, 6> case_kind_names = {
    "setting", "floor", "halved_iterations", "halved_substeps", "halved_dt", "estimate"};

struct AccuracyCase {
  int scene = 0;  ///< index into the study's scenes
  CaseKind kind = CaseKind::setting;
  stepping::StepperSettings stepper;
  int steps_per_frame = 3;
  int estimate_iterations = 0;  ///< estimate: those of the frame's last solve that it waits for

  int sweeps() const { return sweeps_of(stepper); }  ///< in a step
};

StudyScene study_scene(const scenes::SceneSource& source, const AccuracyOptions& options);

/// The setting of the reference: sor, double.
stepping::StepperSettings reference_settings(const StudyScene& scene, const AccuracyOptions& options);

/// All cases of all scenes, scene by scene. Throws core::InputError for a dt that does not fill a frame.
std::vector<AccuracyCase> make_cases(const std::vector<StudyScene>& scenes, const AccuracyOptions& options);

/// Which rank works on which case [num_cases]: by expected cost, the dearest first.
std::vector<int> deal_out(const std::vector<AccuracyCase>& cases, const std::vector<StudyScene>& scenes,
                          int num_ranks);

}  // namespace pbmpi::app
