/// One world in a stepper, for tests of its motion.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "stepping/stepper.h"

namespace pbmpi::ode {

/// The sink of tests that expect no message: the test fails with the line.
void fail_on_warning(const std::string& line);

/// With `quick`, any message of ODE fails the test; with `direct`, any except that of its LCP solver.
class Simulation {
 public:
  Simulation(const model::Model& model, const stepping::StepperSettings& settings);

  void advance(int num_steps);
  const model::State& state() const { return stepper_->state(0); }
  const stepping::Observables& observables() const { return stepper_->observables(0); }
  const model::Model& model() const { return stepper_->model(0); }
  double energy() const { return observables().energy_j; }
  /// Converts a direction fixed in a body to the world frame.
  model::Vec3 direction(int body, const model::Vec3& local) const;

 private:
  std::unique_ptr<stepping::WorldStepper> stepper_;
};

/// The bits of a world after `num_steps` steps, alone in a new stepper.
std::uint64_t hash_after(const model::Model& model, const stepping::StepperSettings& settings, int world,
                         int num_steps);

}  // namespace pbmpi::ode
