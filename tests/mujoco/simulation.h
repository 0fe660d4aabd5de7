/// One world in a stepper, for tests of its motion.
#pragma once

#include <memory>

#include "stepping/stepper.h"

namespace pbmpi::mujoco {

/// MuJoCo's own steps are a quarter of these.
stepping::StepperSettings settings_with(double dt_s = 0.01);

class Simulation {
 public:
  explicit Simulation(const model::Model& model, const stepping::StepperSettings& settings = settings_with());
  /// The same world in ODE's stepper `direct`.
  static Simulation by_ode(const model::Model& model, double dt_s = 0.01);

  void advance(int num_steps);
  const model::State& state() const { return stepper_->state(0); }
  const stepping::Observables& observables() const { return stepper_->observables(0); }
  double energy() const { return observables().energy_j; }
  stepping::WorldStepper& stepper() { return *stepper_; }

 private:
  Simulation(const model::Model& model, std::unique_ptr<stepping::WorldStepper> stepper);

  std::unique_ptr<stepping::WorldStepper> stepper_;
};

/// The bits of a world after `num_steps` steps, alone in a new stepper.
std::uint64_t hash_after(const model::Model& model, int num_steps);

/// The bits after `first` steps, and then `rest` steps in a new stepper that starts from their state alone.
std::uint64_t hash_after_restore(const model::Model& model, int first, int rest);

}  // namespace pbmpi::mujoco
