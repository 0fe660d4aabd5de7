/// One world in Bullet, for tests of its motion.
#pragma once

#include <memory>

#include "stepping/stepper.h"

namespace pbmpi::bullet {

/// Settings for steps of `dt_s` with this many iterations.
stepping::StepperSettings settings_of(double dt_s, int iterations);

class Simulation {
 public:
  Simulation(const model::Model& model, const stepping::StepperSettings& settings);
  /// Starts from this state, at the start of step `step`.
  Simulation(const model::Model& model, const model::State& state, std::int64_t step,
             const stepping::StepperSettings& settings);

  void advance(int num_steps);
  stepping::WorldStepper& stepper() { return *stepper_; }
  const model::State& state() const { return stepper_->state(0); }
  const stepping::Observables& observables() const { return stepper_->observables(0); }
  const model::Model& model() const { return stepper_->model(0); }
  /// Converts a direction fixed in a body to the world frame.
  model::Vec3 direction(int body, const model::Vec3& local) const;

 private:
  std::unique_ptr<stepping::WorldStepper> stepper_;
};

}  // namespace pbmpi::bullet
