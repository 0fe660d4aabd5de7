/// Steps the worlds of one case of a study.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "analysis/pose_errors.h"
#include "app/pbstudy/study/study_scene.h"
#include "model/state.h"
#include "stepping/stepper.h"

namespace pbmpi::app {

/// The worlds of a scene at one step length.
using Worlds = std::vector<std::shared_ptr<const model::Model>>;
/// `effects` go before those that the scene chooses.
Worlds build_worlds(const StudyScene& scene, double dt_s, std::uint64_t seed,
                    const model::EffectChoices& effects = {});

/// A stepper with all worlds of a case, from their initial states on.
class CaseStepper {
 public:
  /// `estimate_iterations` > 0: what it shows is the state after so many iterations of a frame's last solve.
  CaseStepper(const Worlds& worlds, const stepping::StepperSettings& settings, int steps_per_frame,
              int estimate_iterations = 0);

  /// Puts all worlds into `states` [num_worlds], those at the start of frame `frame`.
  void start_from(const std::vector<model::State>& states, int frame);
  /// Seconds of processor time that one frame takes; of an estimate those until it is there.
  double advance_frame();

  /// The state that the last frame showed: its end, or its estimate.
  const model::State& shown(int world) const;
  stepping::Observables observables(int world) const;
  const stepping::WorldStepper& worlds() const { return *stepper_; }
  std::vector<model::State> states() const;

 private:
  std::unique_ptr<stepping::WorldStepper> stepper_;
  stepping::AnytimeStepper* anytime_ = nullptr;  ///< the same, if it is to estimate
  int num_worlds_;
  int steps_per_frame_;
  int estimate_iterations_;
};

/// Errors of all bodies and joints of all worlds, as they are shown, against `reference` [num_worlds].
analysis::PoseErrors errors_of(const CaseStepper& stepper, const Worlds& worlds,
                               const std::vector<model::State>& reference);

/// The run that cases are compared with.
struct Reference {
  Worlds worlds;
  std::vector<std::vector<model::State>>
      states;  ///< [total_frames + 1][num_worlds] at the start of each frame
};
Reference make_reference(const StudyScene& scene, const stepping::StepperSettings& settings);

}  // namespace pbmpi::app
