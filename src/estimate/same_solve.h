/// The estimate taken from the precise solve before it has ended.
#pragma once

#include <map>

#include "stepping/estimator.h"
#include "stepping/stepper.h"

namespace pbmpi::estimate {

/// Begins the precise stepper's next step, and shows its worlds as if the solve ended after `iterations`:
/// nothing is assembled twice. The precise step continues from there. Estimates one step: the last of a frame
/// (PartlyPrecise does those before).
class SameSolve final : public stepping::Estimator {
 public:
  /// `stepper`, borrowed, computes the precise frames. iterations: at most those of a step.
  SameSolve(stepping::AnytimeStepper& stepper, int iterations)
      : stepper_(&stepper), iterations_(iterations) {}

  void estimate(std::span<const stepping::LocalWorld> worlds, std::int64_t step, int num_steps,
                core::PhaseTimes& times) override;
  const model::State& state(int world) const override { return looks_.at(world); }
  stepping::EstimatedSteps steps() const override { return {.coarse = 1}; }

 private:
  stepping::AnytimeStepper* stepper_;
  int iterations_;
  std::map<int, model::State> looks_;  ///< copies: the stepper's own state is gone once a world is mended
};

}  // namespace pbmpi::estimate
