#include "simulation.h"

#include "bullet/bullet_stepper.h"
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
    : OneWorld(model, state, step, make_bullet_stepper(settings, "test: ")) {}

}  // namespace pbmpi::bullet
