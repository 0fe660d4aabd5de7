/// The events of a step, and what drives the axes of joints by them.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>

#include "model/model.h"

namespace pbmpi::effects {

/// The events of a step, in the model's order.
inline std::span<const model::Event> events_of(const model::Model& model, std::int64_t step) {
  // Not equal_range(), whose result clang 14 cannot compile with g++ 12's library.
  const auto first = std::ranges::lower_bound(model.events, step, {}, &model::Event::step);
  const auto end = std::ranges::upper_bound(model.events, step, {}, &model::Event::step);
  return {first, end};
}

/// Does the event replace the motor of this axis?
inline bool sets_motor(const model::Event& event, int joint, int axis) {
  return event.kind == model::EventKind::motor && event.joint == joint && event.axis == axis;
}

/// The motor of an axis after the events of all steps before `step`.
model::AxisMotor motor_before(const model::Model& model, std::int64_t step, int joint, int axis);

/// Does the motor aim at a velocity for good? With a hold rate it aims at a pose, where it comes to rest.
inline bool keeps_moving(const model::AxisMotor& motor) {
  return motor.active() && motor.velocity != 0 && motor.hold_rate == 0;
}

/// Does a motor of the joint keep its axis moving after the events of all steps before `step`?
bool is_driven_before(const model::Model& model, std::int64_t step, int joint);

}  // namespace pbmpi::effects
