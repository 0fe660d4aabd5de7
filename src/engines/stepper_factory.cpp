#include "engines/stepper_factory.h"

#include <utility>

#include "ode/collide/narrow_phase.h"
#include "ode/ode_stepper.h"
#include "solver/spaces/sor_space_stepper.h"
#include "solver/worlds/sor_stepper.h"
#include "stepping/stepper_traits.h"

namespace pbmpi::engines {

std::unique_ptr<stepping::WorldStepper> make_stepper(const stepping::StepperSettings& settings,
                                                     const std::string& warning_prefix) {
  if (traits_of(settings.kind).is_anytime) return make_anytime_stepper(settings);
  return ode::make_ode_stepper(
      settings, [warning_prefix](const std::string& line) { ode::warn_on_stderr(warning_prefix + line); });
}

std::unique_ptr<stepping::AnytimeStepper> make_anytime_stepper(const stepping::StepperSettings& settings) {
  return solver::make_sor_stepper(settings, ode::make_narrow_phase);
}

std::unique_ptr<stepping::SpaceStepper> make_space_stepper(const stepping::StepperSettings& settings,
                                                           std::shared_ptr<const model::Model> model) {
  return solver::make_sor_space_stepper(settings, ode::make_narrow_phase, std::move(model));
}

}  // namespace pbmpi::engines
