#include "bullet/stepper.h"

#include <cstdio>
#include <utility>

#include "bullet/bullet_stepper.h"
#include "core/error.h"

namespace pbmpi::bullet {

BulletStepper::BulletStepper(const stepping::StepperSettings& settings, std::string warning_prefix)
    : settings_(settings), warning_prefix_(std::move(warning_prefix)) {
  core::require_input(settings.dt_s > 0 && settings.dt_s < model::infinity,
                      "dt: " + std::to_string(settings.dt_s) + " s is no time step; give seconds above 0");
  core::require_input(settings.iterations >= 1, "iterations: " + std::to_string(settings.iterations) +
                                                    " sweeps solve nothing; give at least 1");
}

void BulletStepper::make_world(Slot& slot, std::int64_t step) {
  slot.world.reset();
  slot.world = std::make_unique<World>(*slot.model, *slot.targets, slot.state, step, settings_, collider_);
}

void BulletStepper::add(int world, std::shared_ptr<const model::Model> model, const model::State& state,
                        std::int64_t step) {
  core::require_invariant(!slots_.contains(world), "a world was added twice");
  core::require_invariant(state.num_bodies() == model->num_bodies(), "a state does not fit its model");
  Slot slot{std::move(model), std::make_unique<stepping::MotorTargets>(), state, {}, 0, nullptr};
  make_world(slot, step);
  slot.complete_state();
  slots_.emplace(world, std::move(slot));
}

void BulletStepper::remove(int world) {
  core::require_invariant(slots_.erase(world) == 1, "a world was removed that is not there");
}

void BulletStepper::set_state(int world, const model::State& state, std::int64_t step) {
  Slot& slot = get(world);
  core::require_invariant(state.num_bodies() == slot.model->num_bodies(), "a state does not fit its model");
  slot.state = state;
  if (slot.world && slot.world->step() == step) {
    slot.world->set_state(state);
  } else {  // another step has other joint settings; a world that was lost no longer has a Bullet world
    slot.targets->move_to(*slot.model, step);
    make_world(slot, step);
  }
  slot.complete_state();
}

void BulletStepper::set_motor_velocity(int world, int joint, int axis, double velocity) {
  Slot& slot = get(world);
  const std::int64_t step = slot.world ? slot.world->step() : 0;  // a lost world continues in another one
  const auto* target = slot.targets->set(*slot.model, step, joint, axis, velocity);
  if (target == nullptr || !slot.world) return;
  slot.world->aim(*target);
  slot.state.rest.assign(slot.world->rest().begin(), slot.world->rest().end());
}

void BulletStepper::advance(int num_steps, core::PhaseTimes& times) {
  if (num_steps < 1) return;
  core::LapTimer timer(times);
  for (auto& [world, slot] : slots_) {
    const double start_s = core::now_s();
    advance_slot(world, slot, num_steps, timer);
    slot.cost_s = core::now_s() - start_s;
  }
}

void BulletStepper::advance_slot(int world, Slot& slot, int num_steps, core::LapTimer& timer) {
  if (!slot.world) return;
  const bool goes_on = slot.world->advance(num_steps, timer);
  slot.world->read(slot.state, slot.observables);
  if (!goes_on) {
    std::fprintf(stderr, "%sbullet: world %d, step %lld: this world stops here, it is not finite\n",
                 warning_prefix_.c_str(), world, static_cast<long long>(slot.world->step()));
    slot.world.reset();
  }
  timer.lap(core::Phase::integrate);
}

const stepping::StepContacts* BulletStepper::contacts(int world) const {
  const Slot& slot = get(world);
  return settings_.contacts && slot.world ? &slot.world->contacts() : nullptr;
}

const BulletStepper::Slot& BulletStepper::get(int world) const {
  const auto found = slots_.find(world);
  core::require_invariant(found != slots_.end(), "a world was asked for that is not there");
  return found->second;
}

std::unique_ptr<stepping::WorldStepper> make_bullet_stepper(const stepping::StepperSettings& settings,
                                                            const std::string& warning_prefix) {
  return std::make_unique<BulletStepper>(settings, warning_prefix);
}

}  // namespace pbmpi::bullet
