/// One world in Bullet, for tests of its motion.
#pragma once

#include "stepping/stepper.h"
#include "support/one_world.h"

namespace pbmpi::bullet {

/// Settings for steps of `dt_s` with this many iterations.
stepping::StepperSettings settings_of(double dt_s, int iterations);

class Simulation : public support::OneWorld {
 public:
  Simulation(const model::Model& model, const stepping::StepperSettings& settings);
  /// Starts from this state, at the start of step `step`.
  Simulation(const model::Model& model, const model::State& state, std::int64_t step,
             const stepping::StepperSettings& settings);
};

}  // namespace pbmpi::bullet
