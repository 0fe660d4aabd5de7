#include "guarded_run.h"

#include "ode/collide/narrow_phase.h"
#include "ode/ode_stepper.h"
#include "solver/worlds/sor_stepper.h"

namespace pbmpi::stability {

std::unique_ptr<stepping::WorldStepper> make_any_stepper(const stepping::StepperSettings& settings) {
  if (settings.kind == stepping::StepperKind::sor)
    return solver::make_sor_stepper(settings, ode::make_narrow_phase);
  return ode::make_ode_stepper(settings, [](const std::string&) {});
}

std::unique_ptr<GuardedStepper> make_guarded(const std::vector<model::Model>& worlds,
                                             const stepping::StepperSettings& settings, OnBlowup on_blowup) {
  auto stepper = std::make_unique<GuardedStepper>(make_any_stepper(settings),
                                                  GuardSettings{on_blowup, settings, make_any_stepper, {}});
  for (std::size_t i = 0; i < worlds.size(); ++i)
    stepper->add(static_cast<int>(i), std::make_shared<const model::Model>(worlds[i]),
                 initial_state(worlds[i]), 0);
  return stepper;
}

std::vector<stepping::RunEvent> run_frames(GuardedStepper& stepper, int num_frames) {
  std::vector<stepping::RunEvent> events;
  core::PhaseTimes times;
  for (int frame = 0; frame < num_frames; ++frame) {
    stepper.advance(3, times);
    for (stepping::RunEvent& event : stepper.take_events()) events.push_back(std::move(event));
  }
  return events;
}

}  // namespace pbmpi::stability
