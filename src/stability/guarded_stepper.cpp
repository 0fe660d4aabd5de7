#include "stability/guarded_stepper.h"

#include <utility>

#include "core/error.h"
#include "core/marks.h"
#include "stability/finer_steps.h"

namespace pbmpi::stability {

GuardedStepper::GuardedStepper(std::unique_ptr<stepping::WorldStepper> inner, GuardSettings settings)
    : settings_(std::move(settings)), inner_(std::move(inner)) {}

void GuardedStepper::add(int world, std::shared_ptr<const model::Model> model, const model::State& state,
                         std::int64_t step) {
  Slot slot;
  slot.model = model;
  slot.guard = std::make_unique<WorldGuard>(world, model, settings_);
  slot.step = step;
  slot.now = slot.guard->begin(state);
  if (!slot.now.is_frozen()) {
    inner_->add(world, std::move(model), state, step);
    // The stepper completes the state, e.g. with the poses near which bodies rest.
    const model::GuardMemory memory = slot.now.state.guard;
    slot.now.state = inner_->state(world);
    slot.now.state.guard = memory;
  }
  const bool is_new = worlds_.emplace(world, std::move(slot)).second;
  core::require_invariant(is_new, "a world was added twice");
}

void GuardedStepper::remove(int world) {
  const auto found = worlds_.find(world);
  core::require_invariant(found != worlds_.end(), "a world was removed that is not there");
  if (!found->second.now.is_frozen()) inner_->remove(world);
  worlds_.erase(found);
}

void GuardedStepper::set_state(int world, const model::State& state, std::int64_t step) {
  Slot& slot = worlds_.at(world);
  const bool was_frozen = slot.now.is_frozen();
  slot.now = slot.guard->begin(state);
  if (std::exchange(slot.step, step) != step) slot.targets.move_to(*slot.model, step);
  if (slot.now.is_frozen()) {
    if (!was_frozen) inner_->remove(world);
    return;
  }
  if (was_frozen) {
    add_aimed(*inner_, world, slot.model, slot.targets, state, step);
  } else {
    inner_->set_state(world, state, step);
  }
  const model::GuardMemory memory = slot.now.state.guard;
  slot.now.state = inner_->state(world);
  slot.now.state.guard = memory;
}

void GuardedStepper::set_motor_velocity(int world, int joint, int axis, double velocity) {
  Slot& slot = worlds_.at(world);
  const bool changes = slot.targets.set(*slot.model, slot.step, joint, axis, velocity) != nullptr;
  if (slot.now.is_frozen()) return;
  inner_->set_motor_velocity(world, joint, axis, velocity);
  if (changes) slot.now.state.rest = inner_->state(world).rest;  // driven bodies may have woken
}

void GuardedStepper::advance(int num_steps, core::PhaseTimes& times) {
  {  // steps that the guards repeat are not part of the frame
    const core::SectionMark mark(core::SectionMark::Section::precise);
    inner_->advance(num_steps, times);
  }
  if (num_steps == 0) return;
  core::LapTimer timer(times);
  for (auto& [world, slot] : worlds_) {
    if (!slot.now.is_frozen()) slot.cost_s = inner_->cost_s(world);
    end_frame(world, slot, num_steps);
  }
  timer.lap(core::Phase::islands);
}

void GuardedStepper::end_frame(int world, Slot& slot, int num_steps) {
  const std::int64_t first_step = std::exchange(slot.step, slot.step + num_steps);
  if (slot.now.is_frozen()) return;
  const bool is_mended = slot.guard->end_frame(slot.now, {inner_->state(world), inner_->observables(world)},
                                               first_step, num_steps, events_, slot.targets);
  slot.targets.pass(*slot.model, first_step, num_steps);
  if (!is_mended) return;
  inner_->remove(world);
  if (!slot.now.is_frozen()) add_aimed(*inner_, world, slot.model, slot.targets, slot.now.state, slot.step);
}

double GuardedStepper::cost_s(int world) const {
  // Loads are divided by their sum, which must not be 0 where all worlds are frozen.
  constexpr double next_to_nothing_s = 1e-9;
  const Slot& slot = worlds_.at(world);
  return slot.now.is_frozen() ? next_to_nothing_s : slot.cost_s;
}

const stepping::StepProfile* GuardedStepper::profile(int world) const {
  return worlds_.at(world).now.is_frozen() ? nullptr : inner_->profile(world);
}

const stepping::StepContacts* GuardedStepper::contacts(int world) const {
  return worlds_.at(world).now.is_frozen() ? nullptr : inner_->contacts(world);
}

}  // namespace pbmpi::stability
