#include "simulation.h"

#include "mujoco/mujoco_stepper.h"
#include "ode/ode_stepper.h"
#include "stepping/stepper_traits.h"

namespace pbmpi::mujoco {

stepping::StepperSettings settings_with(double dt_s) {
  stepping::StepperSettings settings = default_settings(stepping::StepperKind::mujoco);
  settings.dt_s = dt_s;
  return settings;
}

Simulation::Simulation(const model::Model& model, const stepping::StepperSettings& settings)
    : OneWorld(model, make_mujoco_stepper(settings)) {}

Simulation Simulation::by_ode(const model::Model& model, double dt_s) {
  stepping::StepperSettings settings = settings_with(dt_s);
  settings.kind = stepping::StepperKind::direct;
  return {model, ode::make_ode_stepper(settings, [](const std::string&) {})};
}

std::uint64_t hash_after(const model::Model& model, int num_steps) {
  Simulation simulation(model);
  simulation.advance(num_steps);
  return model::hash(simulation.state());
}

std::uint64_t hash_after_restore(const model::Model& model, int first, int rest) {
  Simulation simulation(model);
  simulation.advance(first);
  const auto stepper = make_mujoco_stepper(settings_with());
  stepper->add(7, std::make_shared<model::Model>(model), simulation.state(), first);
  core::PhaseTimes times;
  stepper->advance(rest, times);
  return model::hash(stepper->state(7));
}

}  // namespace pbmpi::mujoco
