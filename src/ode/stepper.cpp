#include "ode/stepper.h"

#include <cstdio>
#include <utility>

#include "ode/ode_stepper.h"
#include "ode/world.h"

namespace pbmpi::ode {

void warn_on_stderr(const std::string& line) { std::fprintf(stderr, "%s\n", line.c_str()); }

OdeStepper::OdeStepper(const stepping::StepperSettings& settings, WarningSink warn)
    : SlotStepper(settings), log_(std::move(warn)), resources_(std::make_unique<SolverResources>()) {}

OdeStepper::~OdeStepper() {
  end_worlds();
  log_.report_counts();
}

std::unique_ptr<stepping::EngineWorld> OdeStepper::make_world(int id, const Slot& slot, std::int64_t step) {
  return std::make_unique<World>(id, *slot.model, *slot.targets, slot.state, step, settings_, *resources_,
                                 log_);
}

void OdeStepper::call_engine(int world, std::int64_t step, const std::function<void()>& call) {
  log_.set_place(world, step);
  const MessageScope scope(log_);
  call();
}

void OdeStepper::advance_world(int id, Slot& slot, int num_steps, core::LapTimer& timer) {
  try {
    SlotStepper::advance_world(id, slot, num_steps, timer);
  } catch (const EngineError& error) {
    survive(slot);
    log_.warn(std::string("this world stops here, it is not finite: ") + error.what());
  }
}

/// Called while an EngineError is handled. One world that becomes NaN must not end the others: it is shown as
/// it is, and the others go on; ODE would fail an assertion if it were stepped again. Any other error ends
/// the stepper.
void OdeStepper::survive(Slot& failed) {
  failed.world->read(failed.state, failed.observables);
  if (failed.observables.nonfinite == 0) {
    resources_->abandon();
    throw;
  }
  failed.world.reset();
  move_to_fresh_resources();
}

/// A world that starts from its state continues bit for bit, so the worlds can be made anew.
void OdeStepper::move_to_fresh_resources() {
  const auto failed = std::exchange(resources_, std::make_unique<SolverResources>());
  for (auto& [id, slot] : slots_) {
    if (slot.world) slot.world = make_world(id, slot, slot.world->step());
  }
  failed->abandon();
}

std::unique_ptr<stepping::WorldStepper> make_ode_stepper(const stepping::StepperSettings& settings,
                                                         WarningSink warn) {
  return std::make_unique<OdeStepper>(settings, std::move(warn));
}

std::string precision_text() { return is_single_precision ? "single" : "double"; }

}  // namespace pbmpi::ode
