#include "every_stepper.h"

#include "ode/collide/narrow_phase.h"
#include "ode/ode_stepper.h"
#include "scenes/scene.h"
#include "solver/worlds/sor_stepper.h"
#include "stepping/step_options.h"

namespace pbmpi::scenes {

using stepping::StepperKind;
using stepping::StepperSettings;

std::vector<SteppedBy> every_stepper() {
  const StepperSettings ode_law = default_settings(StepperKind::sor, stepping::Law::ode);
  StepperSettings single = ode_law, substeps = ode_law;
  single.precision = stepping::Precision::single;
  substeps.substeps = 3;
  return {{"quick", default_settings(StepperKind::quick)},
          {"direct", default_settings(StepperKind::direct)},
          {"sor", ode_law},
          {"sor_single", single},
          {"sor_with_substeps", substeps},
          {"sor_with_memory", default_settings(StepperKind::sor)}};
}

std::unique_ptr<stepping::WorldStepper> make_stepper(const StepperSettings& settings) {
  return settings.kind == StepperKind::sor ? solver::make_sor_stepper(settings, ode::make_narrow_phase)
                                           : ode::make_ode_stepper(settings, [](const std::string&) {});
}

model::State state_after(const std::string& toml, const StepperSettings& settings, int num_steps) {
  const auto model = parse_scene({"test", "test.toml", toml})->build(0, 1);
  const auto stepper = make_stepper(settings);
  stepper->add(0, model, model::initial_state(*model), 0);
  core::PhaseTimes times;
  stepper->advance(num_steps, times);
  return stepper->state(0);
}

}  // namespace pbmpi::scenes
