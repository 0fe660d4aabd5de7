/// Steps the worlds of one case of a study.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "analysis/pose_errors.h"
#include "app/common/step_arguments.h"
#include "app/pbstudy/study/study_scene.h"
#include "model/state.h"
#include "stepping/stepper.h"

namespace pbmpi::app {

/// The worlds of a scene at one step length.
using Worlds = std::vector<std::shared_ptr<const model::Model>>;
/// `effects` override those that the scene chooses. Events happen at the times at which they do with the
/// scene's own step, whatever dt: otherwise a launch would come up to half a step earlier or later.
Worlds build_worlds(const StudyScene& scene, double dt_s, std::uint64_t seed,
                    const model::EffectChoices& effects = {});

/// A stepper with all worlds of a case, starting from their initial states.
class CaseStepper {
 public:
  /// With `estimate` it shows the estimate of a frame (FEEC) instead of its end.
  CaseStepper(const Worlds& worlds, const stepping::StepperSettings& settings, int steps_per_frame,
              const std::optional<stepping::StepperSettings>& estimate = std::nullopt);

  /// Puts all worlds into `states` [num_worlds] at the start of frame `frame`.
  void start_from(const std::vector<model::State>& states, int frame);
  /// Seconds of processor time that one frame takes; for an estimate, until it is there.
  double advance_frame();

  /// The state that the last frame showed: its end, or its estimate.
  const model::State& shown(int world) const;
  stepping::Observables observables(int world) const;
  const stepping::WorldStepper& worlds() const { return *stepper_; }
  std::vector<model::State> states() const;

 private:
  double estimate_frame();

  std::unique_ptr<stepping::WorldStepper> stepper_;
  std::unique_ptr<stepping::Estimator> estimator_;  ///< null without an estimate
  int num_worlds_;
  int steps_per_frame_;
  std::int64_t step_ = 0;
};

/// The poses of a state, borrowed.
analysis::PoseView view_of(const model::State& state);

/// Errors of all bodies and joints of all worlds, in `states` [num_worlds], against `reference` [num_worlds].
analysis::PoseErrors errors_between(const Worlds& worlds, const std::vector<model::State>& states,
                                    const std::vector<model::State>& reference);
/// Errors of the states that `stepper` shows.
analysis::PoseErrors errors_of(const CaseStepper& stepper, const Worlds& worlds,
                               const std::vector<model::State>& reference);

/// The run that cases are compared with.
struct Reference {
  Worlds worlds;
  std::vector<std::vector<model::State>>
      states;  ///< [total_frames + 1][num_worlds] at the start of each frame
};
/// The reference's worlds with steps of dt.
Worlds worlds_at_step(const Reference& reference, const StudyScene& scene, double dt_s, std::uint64_t seed);
Reference make_reference(const StudyScene& scene, const stepping::StepperSettings& settings);

}  // namespace pbmpi::app
