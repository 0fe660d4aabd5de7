#include "ode/stepper.h"

#include <cstdio>

#include "core/error.h"

namespace pbmpi::ode {

void warn_on_stderr(const std::string& line) { std::fprintf(stderr, "%s\n", line.c_str()); }

OdeStepper::OdeStepper(const stepping::StepperSettings& settings, WarningSink warn)
    : settings_(settings), log_(std::move(warn)), resources_(std::make_unique<SolverResources>()) {
  core::require_input(settings.dt_s > 0 && settings.dt_s < model::infinity,
                      "dt: " + std::to_string(settings.dt_s) + " s is no time step; give seconds above 0");
  core::require_input(settings.iterations >= 1, "iterations: " + std::to_string(settings.iterations) +
                                                    " sweeps solve nothing; give at least 1");
}

OdeStepper::~OdeStepper() { log_.report_counts(); }

void OdeStepper::add(int world, std::shared_ptr<const model::Model> model, const model::State& state,
                     std::int64_t step) {
  core::require_invariant(!slots_.contains(world), "a world was added twice");
  core::require_invariant(state.num_bodies() == model->num_bodies(), "a state does not fit its model");
  log_.set_place(world, step);
  const MessageScope scope(log_);
  Slot slot{std::move(model), std::make_unique<stepping::MotorTargets>(), state, {}, 0, {}, nullptr};
  slot.world =
      std::make_unique<World>(world, *slot.model, *slot.targets, state, step, settings_, *resources_);
  slot.complete_state();
  slots_.emplace(world, std::move(slot));
}

void OdeStepper::remove(int world) {
  core::require_invariant(slots_.erase(world) == 1, "a world was removed that is not there");
}

void OdeStepper::set_state(int world, const model::State& state, std::int64_t step) {
  const auto found = slots_.find(world);
  core::require_invariant(found != slots_.end(), "a state was set of a world that is not there");
  Slot& slot = found->second;
  core::require_invariant(state.num_bodies() == slot.model->num_bodies(), "a state does not fit its model");
  log_.set_place(world, step);
  const MessageScope scope(log_);
  slot.state = state;
  if (slot.world && slot.world->step() == step) {
    slot.world->set_state(state);
  } else {  // another step has other joint settings; a world that was lost no longer has an ODE world
    slot.targets->move_to(*slot.model, step);
    slot.world =
        std::make_unique<World>(world, *slot.model, *slot.targets, state, step, settings_, *resources_);
  }
  slot.complete_state();
}

void OdeStepper::set_motor_velocity(int world, int joint, int axis, double velocity) {
  const auto found = slots_.find(world);
  core::require_invariant(found != slots_.end(), "a motor was aimed of a world that is not there");
  Slot& slot = found->second;
  const std::int64_t step = slot.world ? slot.world->step() : 0;  // a lost world continues in another one
  const auto* target = slot.targets->set(*slot.model, step, joint, axis, velocity);
  if (target == nullptr || !slot.world) return;
  slot.world->aim(*target);
  slot.state.rest.assign(slot.world->rest().begin(), slot.world->rest().end());
}

void OdeStepper::advance(int num_steps, core::PhaseTimes& times) {
  if (num_steps < 1) return;
  const MessageScope scope(log_);
  core::LapTimer timer(times);
  for (auto& entry : slots_) {
    const double start_s = core::now_s();
    advance_slot(entry.second, num_steps, timer);
    entry.second.cost_s = core::now_s() - start_s;
  }
}

void OdeStepper::profile_last_step() {
  if (!settings_.profile) return;
  const MessageScope scope(log_);
  for (auto& entry : slots_) {
    Slot& slot = entry.second;
    slot.profile.reset();
    if (slot.world) slot.profile = slot.world->profile_last_step();
  }
}

const stepping::StepProfile* OdeStepper::profile(int world) const {
  const Slot& slot = get(world);
  return slot.profile ? &*slot.profile : nullptr;
}

const stepping::StepContacts* OdeStepper::contacts(int world) const {
  const Slot& slot = get(world);
  return settings_.contacts && slot.world ? &slot.world->contacts() : nullptr;
}

void OdeStepper::advance_slot(Slot& slot, int num_steps, core::LapTimer& timer) {
  if (!slot.world) return;
  try {
    slot.world->advance(num_steps, timer, log_);
    slot.world->read(slot.state, slot.observables);
  } catch (const EngineError& error) {
    survive(slot);
    log_.warn(std::string("this world stops here, it is not finite: ") + error.what());
  }
  timer.lap(core::Phase::integrate);
}

/// Called while an EngineError is handled. One world that becomes NaN must not end the others: it is shown as
/// it is, and the others go on. Any other error ends the stepper.
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
  auto fresh = std::make_unique<SolverResources>();
  for (auto& [id, slot] : slots_) {
    if (!slot.world) continue;
    const std::int64_t step = slot.world->step();
    slot.world = std::make_unique<World>(id, *slot.model, *slot.targets, slot.state, step, settings_, *fresh);
  }
  resources_->abandon();
  resources_ = std::move(fresh);
}

const OdeStepper::Slot& OdeStepper::get(int world) const {
  const auto found = slots_.find(world);
  core::require_invariant(found != slots_.end(), "a world was asked for that is not there");
  return found->second;
}

std::unique_ptr<stepping::WorldStepper> make_ode_stepper(const stepping::StepperSettings& settings,
                                                         WarningSink warn) {
  return std::make_unique<OdeStepper>(settings, std::move(warn));
}

std::string precision_text() { return is_single_precision ? "single" : "double"; }

}  // namespace pbmpi::ode
