#include "stepping/engine/slot_stepper.h"

#include <cstdio>
#include <utility>

#include <fmt/core.h>

#include "core/error.h"

namespace pbmpi::stepping {

SlotStepper::SlotStepper(const StepperSettings& settings) : settings_(settings) {
  core::require_input(settings.dt_s > 0 && settings.dt_s < model::infinity,
                      "dt: " + std::to_string(settings.dt_s) + " s is no time step; give seconds above 0");
  core::require_input(settings.iterations >= 1, "iterations: " + std::to_string(settings.iterations) +
                                                    " iterations solve nothing; give at least 1");
}

void SlotStepper::Slot::complete_state() {
  state.memory.clear();
  state.rest.clear();
  if (!world) return;
  state.rest = world->rest();
  state.broken_in = world->broken_in();
}

void SlotStepper::add(int world, std::shared_ptr<const model::Model> model, const model::State& state,
                      std::int64_t step) {
  core::require_invariant(!slots_.contains(world), "a world was added twice");
  core::require_invariant(state.num_bodies() == model->num_bodies(), "a state does not fit its model");
  Slot slot{std::move(model), std::make_unique<MotorTargets>(), state, {}, 0, {}, nullptr};
  start(world, slot, step);
  slot.complete_state();
  slots_.emplace(world, std::move(slot));
}

void SlotStepper::remove(int world) {
  core::require_invariant(slots_.erase(world) == 1, "a world was removed that is not there");
}

void SlotStepper::set_state(int world, const model::State& state, std::int64_t step) {
  Slot& slot = get(world);
  core::require_invariant(state.num_bodies() == slot.model->num_bodies(), "a state does not fit its model");
  slot.state = state;
  if (slot.world && slot.world->step() == step) {
    call_engine(world, step, [&] { slot.world->set_state(state); });
    if (slot.world->is_lost()) slot.world.reset();
  } else {  // another step has other joint settings; a world that was lost no longer has one in the engine
    slot.targets->move_to(*slot.model, step);
    start(world, slot, step);
  }
  slot.complete_state();
}

/// A world whose state the engine cannot step from is lost from the start.
void SlotStepper::start(int id, Slot& slot, std::int64_t step) {
  slot.world.reset();
  call_engine(id, step, [&] { slot.world = make_world(id, slot, step); });
  if (slot.world->is_lost()) slot.world.reset();
}

void SlotStepper::set_motor_velocity(int world, int joint, int axis, double velocity) {
  Slot& slot = get(world);
  const std::int64_t step = slot.world ? slot.world->step() : 0;  // a lost world continues in another one
  const auto* target = slot.targets->set(*slot.model, step, joint, axis, velocity);
  if (target == nullptr || !slot.world) return;
  slot.world->aim(*target);
  slot.state.rest = slot.world->rest();
}

void SlotStepper::advance(int num_steps, core::PhaseTimes& times) {
  if (num_steps < 1) return;
  core::LapTimer timer(times);
  for (auto& [id, slot] : slots_) {
    const double start_s = core::now_s();
    if (slot.world) {
      const auto step = [&, id = id, &slot = slot] { advance_world(id, slot, num_steps, timer); };
      call_engine(id, slot.world->step(), step);
      timer.lap(core::Phase::integrate);
    }
    slot.cost_s = core::now_s() - start_s;
  }
}

void SlotStepper::advance_world(int id, Slot& slot, int num_steps, core::LapTimer& timer) {
  slot.world->advance(num_steps, timer);
  slot.world->read(slot.state, slot.observables);
  if (!slot.world->is_lost()) return;
  report_loss(id, slot.world->step());
  slot.world.reset();
}

void SlotStepper::call_engine(int, std::int64_t, const std::function<void()>& call) { call(); }

void SlotStepper::report_loss(int, std::int64_t) const {}

void SlotStepper::profile_last_step() {
  if (!settings_.profile) return;
  for (auto& [id, slot] : slots_) {
    slot.profile.reset();
    if (!slot.world) continue;
    call_engine(id, slot.world->step(), [&slot = slot] { slot.profile = slot.world->profile_last_step(); });
  }
}

const StepProfile* SlotStepper::profile(int world) const {
  const Slot& slot = get(world);
  return slot.profile ? &*slot.profile : nullptr;
}

const StepContacts* SlotStepper::contacts(int world) const {
  const Slot& slot = get(world);
  return settings_.contacts && slot.world ? &slot.world->contacts() : nullptr;
}

const SlotStepper::Slot& SlotStepper::get(int world) const {
  const auto found = slots_.find(world);
  core::require_invariant(found != slots_.end(), "a world was asked for that is not there");
  return found->second;
}

void print_loss(const std::string& engine, int world, std::int64_t step, const std::string& reason) {
  fmt::print(stderr, "{}: world {}, step {}: this world stops here, {}\n", engine, world, step, reason);
}

}  // namespace pbmpi::stepping
