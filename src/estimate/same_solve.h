/// The estimate from the precise solve itself, looked at before it has ended.
#pragma once

#include <map>

#include "stepping/estimator.h"
#include "stepping/stepper.h"

namespace pbmpi::estimate {

/// Begins the precise stepper's next step, and shows its worlds as they would be if the solve ended after so
/// many iterations: nothing is assembled twice. Whoever advances the stepper goes on from there. For one
/// step: the last of a frame (PartlyPrecise does those before).
class SameSolve final : public stepping::Estimator {
 public:
  /// `stepper` is borrowed: the one that computes the precise frames. iterations: at most those of a step.
  SameSolve(stepping::AnytimeStepper& stepper, int iterations)
      : stepper_(&stepper), iterations_(iterations) {}

  void estimate(std::span<const stepping::LocalWorld> worlds, std::int64_t step, int num_steps,
                core::PhaseTimes& times) override;
  const model::State& state(int world) const override { return looks_.at(world); }
  stepping::EstimatedSteps steps() const override { return {.coarse = 1}; }

 private:
  stepping::AnytimeStepper* stepper_;
  int iterations_;
  std::map<int, model::State> looks_;  ///< copies: the stepper's own do not outlive a world that is mended
};

}  // namespace pbmpi::estimate
