#include "simulation.h"

#include "bullet/bullet_stepper.h"
#include "model/validate.h"
#include "stepping/stepper_traits.h"

namespace pbmpi::bullet {

stepping::StepperSettings settings_of(double dt_s, int iterations) {
  stepping::StepperSettings settings = default_settings(stepping::StepperKind::bullet);
  settings.dt_s = dt_s;
  settings.iterations = iterations;
  return settings;
}

Simulation::Simulation(const model::Model& model, const stepping::StepperSettings& settings)
    : Simulation(model, model::initial_state(model), 0, settings) {}

Simulation::Simulation(const model::Model& model, const model::State& state, std::int64_t step,
                       const stepping::StepperSettings& settings)
    : stepper_(make_bullet_stepper(settings, "test: ")) {
  model::validate(model, "test");
  stepper_->add(0, std::make_shared<model::Model>(model), state, step);
}

void Simulation::advance(int num_steps) {
  core::PhaseTimes times;
  stepper_->advance(num_steps, times);
}

model::Vec3 Simulation::direction(int body, const model::Vec3& local) const {
  return state().orientation[static_cast<std::size_t>(body)].to_eigen() * local;
}

}  // namespace pbmpi::bullet
