#include "bullet/objects/held_poses.h"

#include <algorithm>

namespace pbmpi::bullet {

HeldPoses::HeldPoses(const model::Model& model, AxisJoints& joints) : joints_(&joints) {
  for (int j = 0; j < model.num_joints(); ++j) {
    const model::Joint& joint = model.joints[static_cast<std::size_t>(j)];
    for (int axis = 0; axis < 2; ++axis) replace(j, axis, joint.motors[static_cast<std::size_t>(axis)]);
  }
}

void HeldPoses::replace(int joint, int axis, const model::AxisMotor& motor) {
  std::erase_if(held_, [&](const Held& held) { return held.joint == joint && held.axis == axis; });
  if (motor.active() && motor.hold_rate > 0) held_.push_back({joint, axis, motor});
}

/// A rate above 1 / dt would overshoot.
void HeldPoses::aim(double dt_s) const {
  for (const Held& held : held_) {
    model::AxisMotor motor = held.motor;
    motor.velocity -= std::min(motor.hold_rate, 1 / dt_s) * joints_->coordinate(held.joint, held.axis);
    joints_->set_motor(held.joint, held.axis, motor);
  }
}

}  // namespace pbmpi::bullet
