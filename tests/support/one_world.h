/// One world in a stepper, for tests of its motion.
#pragma once

#include <memory>
#include <utility>

#include "model/validate.h"
#include "stepping/stepper.h"

namespace pbmpi::support {

class OneWorld {
 public:
  /// Starts from `state`, that at the start of step `step`.
  OneWorld(const model::Model& model, const model::State& state, std::int64_t step,
           std::unique_ptr<stepping::WorldStepper> stepper)
      : stepper_(std::move(stepper)) {
    model::validate(model, "test");
    stepper_->add(0, std::make_shared<model::Model>(model), state, step);
  }
  OneWorld(const model::Model& model, std::unique_ptr<stepping::WorldStepper> stepper)
      : OneWorld(model, model::initial_state(model), 0, std::move(stepper)) {}

  void advance(int num_steps) {
    core::PhaseTimes times;
    stepper_->advance(num_steps, times);
  }
  stepping::WorldStepper& stepper() { return *stepper_; }
  const model::State& state() const { return stepper_->state(0); }
  const stepping::Observables& observables() const { return stepper_->observables(0); }
  const model::Model& model() const { return stepper_->model(0); }
  double energy() const { return observables().energy_j; }
  /// Converts a direction fixed in a body to the world frame.
  model::Vec3 direction(int body, const model::Vec3& local) const {
    return state().orientation[static_cast<std::size_t>(body)].to_eigen() * local;
  }

 private:
  std::unique_ptr<stepping::WorldStepper> stepper_;
};

}  // namespace pbmpi::support
