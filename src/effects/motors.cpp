#include "effects/motors.h"

namespace pbmpi::effects {

model::AxisMotor motor_before(const model::Model& model, std::int64_t step, int joint, int axis) {
  model::AxisMotor motor =
      model.joints[static_cast<std::size_t>(joint)].motors[static_cast<std::size_t>(axis)];
  for (const model::Event& event : model.events) {
    if (event.step >= step) break;
    if (sets_motor(event, joint, axis)) motor = event.motor;
  }
  return motor;
}

bool is_driven_before(const model::Model& model, std::int64_t step, int joint) {
  return keeps_moving(motor_before(model, step, joint, 0)) ||
         keeps_moving(motor_before(model, step, joint, 1));
}

}  // namespace pbmpi::effects
