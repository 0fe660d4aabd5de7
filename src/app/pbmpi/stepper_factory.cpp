#include "app/pbmpi/stepper_factory.h"

#include <utility>

#include "model/names.h"
#include "ode/narrow_phase.h"
#include "ode/ode_stepper.h"
#include "solver/simd.h"
#include "solver/sor_stepper.h"
#include "solver/space_world.h"

namespace pbmpi::app {

std::unique_ptr<model::WorldStepper> make_stepper(const model::StepperSettings& settings,
                                                  const std::string& warning_prefix) {
  if (settings.kind == model::StepperKind::sor) return make_anytime_stepper(settings);
  return ode::make_ode_stepper(
      settings, [warning_prefix](const std::string& line) { ode::warn_on_stderr(warning_prefix + line); });
}

std::unique_ptr<model::AnytimeStepper> make_anytime_stepper(const model::StepperSettings& settings) {
  return solver::make_sor_stepper(settings, ode::make_narrow_phase);
}

std::unique_ptr<model::SpaceStepper> make_space_stepper(const model::StepperSettings& settings,
                                                        std::shared_ptr<const model::Model> model) {
  return solver::make_space_world(settings, ode::make_narrow_phase, std::move(model));
}

std::string simd_text(const model::StepperSettings& settings) {
  if (settings.kind != model::StepperKind::sor) return "";
  const model::Simd simd = settings.simd == model::Simd::automatic ? solver::best_simd() : settings.simd;
  const int lanes = solver::num_lanes(simd, settings.precision);
  return std::string(model::name_of(simd)) + ", " + std::to_string(lanes) + (lanes == 1 ? " lane" : " lanes");
}

}  // namespace pbmpi::app
