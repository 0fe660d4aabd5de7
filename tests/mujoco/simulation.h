/// One world in MuJoCo, for tests of its motion.
#pragma once

#include "stepping/stepper.h"
#include "support/one_world.h"

namespace pbmpi::mujoco {

/// MuJoCo's own steps are a quarter of these.
stepping::StepperSettings settings_with(double dt_s = 0.01);

class Simulation : public support::OneWorld {
 public:
  explicit Simulation(const model::Model& model, const stepping::StepperSettings& settings = settings_with());
  /// The same world in ODE's stepper `direct`.
  static Simulation by_ode(const model::Model& model, double dt_s = 0.01);

 private:
  using OneWorld::OneWorld;
};

/// The bits of a world after `num_steps` steps, alone in a new stepper.
std::uint64_t hash_after(const model::Model& model, int num_steps);

/// The bits after `first` steps, and then `rest` steps in a new stepper that starts from their state alone.
std::uint64_t hash_after_restore(const model::Model& model, int first, int rest);

}  // namespace pbmpi::mujoco
