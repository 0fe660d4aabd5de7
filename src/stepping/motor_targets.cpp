#include "stepping/motor_targets.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "core/error.h"
#include "effects/motors.h"

namespace pbmpi::stepping {
namespace {

using core::require_input;

void require_motor(const model::Model& model, int joint, int axis) {
  require_input(joint >= 0 && joint < model.num_joints(),
                "the motor of joint " + std::to_string(joint) + " cannot be aimed: the world has " +
                    std::to_string(model.num_joints()) + " joints; count them from 0");
  require_input(axis == 0 || axis == 1, "the motor of axis " + std::to_string(axis) +
                                            " cannot be aimed: a joint has axes 0 and 1; name one of them");
  const model::Joint& held = model.joints[static_cast<std::size_t>(joint)];
  const bool has_motor = held.motors[static_cast<std::size_t>(axis)].active() ||
                         std::any_of(model.events.begin(), model.events.end(), [&](const auto& event) {
                           return effects::sets_motor(event, joint, axis) && event.motor.active();
                         });
  require_input(has_motor, "joint '" + held.name + "' has no motor on axis " + std::to_string(axis + 1) +
                               " to aim; give it one with a max_force in the scene");
}

/// What the targets are sorted by.
constexpr auto place = [](const MotorTargets::Target& target) {
  return std::pair(target.joint, target.axis);
};

}  // namespace

const MotorTargets::Target* MotorTargets::set(const model::Model& model, std::int64_t step, int joint,
                                              int axis, double velocity) {
  if (!std::isfinite(velocity)) {
    throw core::InputError("a motor cannot aim at a velocity of " + std::to_string(velocity) +
                           "; give a finite number of rad/s or m/s");
  }
  const std::pair wanted(joint, axis);
  auto at = std::ranges::lower_bound(targets_, wanted, {}, place);
  if (at == targets_.end() || place(*at) != wanted) {
    require_motor(model, joint, axis);
    at = targets_.insert(at, {joint, axis, effects::motor_before(model, step, joint, axis)});
  }
  if (at->motor.velocity == velocity) return nullptr;
  at->motor.velocity = velocity;
  return &*at;
}

void MotorTargets::pass(const model::Model& model, std::int64_t first_step, std::int64_t num_steps) {
  if (targets_.empty()) return;
  auto event = std::ranges::lower_bound(model.events, first_step, {}, &model::Event::step);
  for (; event != model.events.end() && event->step < first_step + num_steps; ++event)
    std::erase_if(targets_, [&](const Target& target) {
      return effects::sets_motor(*event, target.joint, target.axis);
    });
}

bool MotorTargets::drive(const model::Model& model, std::int64_t step, int joint) const {
  const auto drives_axis = [&](int axis) {
    const auto target = std::ranges::lower_bound(targets_, std::pair(joint, axis), {}, place);
    const bool is_steered = target != targets_.end() && place(*target) == std::pair(joint, axis);
    return effects::keeps_moving(is_steered ? target->motor
                                            : effects::motor_before(model, step, joint, axis));
  };
  return drives_axis(0) || drives_axis(1);
}

void MotorTargets::move_to(const model::Model& model, std::int64_t step) {
  for (Target& target : targets_) {
    const double velocity = target.motor.velocity;
    target.motor = effects::motor_before(model, step, target.joint, target.axis);
    target.motor.velocity = velocity;
  }
}

}  // namespace pbmpi::stepping
