#include "model/motors.h"

namespace pbmpi::model {

AxisMotor motor_before(const Model& model, std::int64_t step, int joint, int axis) {
  AxisMotor motor = model.joints[static_cast<std::size_t>(joint)].motors[static_cast<std::size_t>(axis)];
  for (const Event& event : model.events) {
    if (event.step >= step) break;
    if (event.kind == EventKind::motor && event.joint == joint && event.axis == axis) motor = event.motor;
  }
  return motor;
}

bool is_driven_before(const Model& model, std::int64_t step, int joint) {
  return keeps_moving(motor_before(model, step, joint, 0)) ||
         keeps_moving(motor_before(model, step, joint, 1));
}

}  // namespace pbmpi::model
