#include "mujoco/stepper.h"

#include <cstdio>
#include <utility>

#include "core/error.h"
#include "mujoco/mujoco_stepper.h"

namespace pbmpi::mujoco {

MujocoStepper::MujocoStepper(const stepping::StepperSettings& settings, std::string warning_prefix)
    : settings_(settings), warning_prefix_(std::move(warning_prefix)) {
  core::require_input(settings.dt_s > 0 && settings.dt_s < model::infinity,
                      "dt: " + std::to_string(settings.dt_s) + " s is no time step; give seconds above 0");
  core::require_input(settings.iterations >= 1, "iterations: " + std::to_string(settings.iterations) +
                                                    " iterations solve nothing; give at least 1");
}

/// A world whose state is not finite has no MuJoCo world.
void MujocoStepper::start(Slot& slot, std::int64_t step) {
  slot.world.reset();
  const MessageScope scope;
  auto world = std::make_unique<World>(*slot.model, *slot.targets, slot.state, step, settings_);
  if (!world->is_lost()) slot.world = std::move(world);
}

void MujocoStepper::add(int world, std::shared_ptr<const model::Model> model, const model::State& state,
                        std::int64_t step) {
  core::require_invariant(!slots_.contains(world), "a world was added twice");
  core::require_invariant(state.num_bodies() == model->num_bodies(), "a state does not fit its model");
  Slot slot{std::move(model), std::make_unique<stepping::MotorTargets>(), state, {}, 0, nullptr};
  start(slot, step);
  slot.complete_state();
  slots_.emplace(world, std::move(slot));
}

void MujocoStepper::remove(int world) {
  core::require_invariant(slots_.erase(world) == 1, "a world was removed that is not there");
}

void MujocoStepper::set_state(int world, const model::State& state, std::int64_t step) {
  const auto found = slots_.find(world);
  core::require_invariant(found != slots_.end(), "a state was set of a world that is not there");
  Slot& slot = found->second;
  core::require_invariant(state.num_bodies() == slot.model->num_bodies(), "a state does not fit its model");
  slot.state = state;
  if (slot.world && slot.world->step() == step) {
    const MessageScope scope;
    slot.world->set_state(state);
    if (slot.world->is_lost()) slot.world.reset();
  } else {  // another step has other joint settings
    slot.targets->move_to(*slot.model, step);
    start(slot, step);
  }
  slot.complete_state();
}

void MujocoStepper::set_motor_velocity(int world, int joint, int axis, double velocity) {
  const auto found = slots_.find(world);
  core::require_invariant(found != slots_.end(), "a motor was aimed of a world that is not there");
  Slot& slot = found->second;
  const std::int64_t step = slot.world ? slot.world->step() : 0;  // a lost world continues in another one
  const auto* target = slot.targets->set(*slot.model, step, joint, axis, velocity);
  if (target != nullptr && slot.world) slot.world->aim(*target);
}

void MujocoStepper::advance(int num_steps, core::PhaseTimes& times) {
  if (num_steps < 1) return;
  const MessageScope scope;
  core::LapTimer timer(times);
  for (auto& [id, slot] : slots_) {
    const double start_s = core::now_s();
    advance_slot(id, slot, num_steps, timer);
    slot.cost_s = core::now_s() - start_s;
  }
}

/// A world that MuJoCo would refuse at its start is an error of the run once it is under way.
void MujocoStepper::advance_slot(int id, Slot& slot, int num_steps, core::LapTimer& timer) {
  if (!slot.world) return;
  const auto place = [&] {
    return " (world " + std::to_string(id) + ", step " + std::to_string(slot.world->step()) + ")";
  };
  try {
    slot.world->advance(num_steps, timer);
  } catch (const core::InputError& error) {
    throw core::RunError(error.what() + place());
  } catch (const EngineError& error) {
    throw core::RunError(error.what() + place());
  }
  slot.world->read(slot.state, slot.observables);
  if (slot.world->is_lost()) {
    std::fprintf(stderr,
                 "%smujoco: world %d, step %lld: this world stops here, its accelerations are not finite\n",
                 warning_prefix_.c_str(), id, static_cast<long long>(slot.world->step()));
    slot.world.reset();
  }
  timer.lap(core::Phase::integrate);
}

const stepping::StepContacts* MujocoStepper::contacts(int world) const {
  const Slot& slot = get(world);
  return settings_.contacts && slot.world ? &slot.world->contacts() : nullptr;
}

const MujocoStepper::Slot& MujocoStepper::get(int world) const {
  const auto found = slots_.find(world);
  core::require_invariant(found != slots_.end(), "a world was asked for that is not there");
  return found->second;
}

std::unique_ptr<stepping::WorldStepper> make_mujoco_stepper(const stepping::StepperSettings& settings,
                                                            const std::string& warning_prefix) {
  return std::make_unique<MujocoStepper>(settings, warning_prefix);
}

}  // namespace pbmpi::mujoco
