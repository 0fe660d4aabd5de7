#include "engines/stepper_factory.h"

#include <utility>

#include "engines/engine_builds.h"
#include "engines/optional_engines.h"
#include "ode/collide/narrow_phase.h"
#include "ode/ode_stepper.h"
#include "solver/spaces/sor_space_stepper.h"
#include "solver/worlds/sor_stepper.h"
#include "stepping/names.h"
#include "stepping/stepper_traits.h"
#ifdef PBMPI_HAS_BULLET
#include "bullet/bullet_stepper.h"
#endif
#ifdef PBMPI_HAS_MUJOCO
#include "mujoco/mujoco_stepper.h"
#endif

namespace pbmpi::engines {

std::unique_ptr<stepping::WorldStepper> make_stepper(const stepping::StepperSettings& settings,
                                                     const std::string& warning_prefix) {
  if (settings.kind == stepping::StepperKind::sor)
    return solver::make_sor_stepper(settings, ode::make_narrow_phase);
  require_in_build(settings.kind, "stepper " + std::string(name_of(settings.kind)));
#ifdef PBMPI_HAS_BULLET
  if (settings.kind == stepping::StepperKind::bullet)
    return bullet::make_bullet_stepper(settings, warning_prefix);
#endif
#ifdef PBMPI_HAS_MUJOCO
  if (settings.kind == stepping::StepperKind::mujoco)
    return mujoco::make_mujoco_stepper(settings, warning_prefix);
#endif
  return ode::make_ode_stepper(
      settings, [warning_prefix](const std::string& line) { ode::warn_on_stderr(warning_prefix + line); });
}

std::unique_ptr<stepping::SpaceStepper> make_space_stepper(const stepping::StepperSettings& settings,
                                                           std::shared_ptr<const model::Model> model) {
  return solver::make_sor_space_stepper(settings, ode::make_narrow_phase, std::move(model));
}

}  // namespace pbmpi::engines
