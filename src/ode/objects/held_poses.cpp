#include "ode/objects/held_poses.h"

#include "ode/objects/joints.h"

namespace pbmpi::ode {

HeldPoses::HeldPoses(const model::Model& model, const std::vector<dJointID>& joints)
    : model_(&model), joints_(joints) {
  for (std::size_t j = 0; j < model.joints.size(); ++j) {
    for (int axis = 0; axis < 2; ++axis) replace(static_cast<int>(j), axis, model.joints[j].motors[axis]);
  }
}

void HeldPoses::replace(int joint, int axis, const model::AxisMotor& motor) {
  std::erase_if(held_, [&](const Held& held) { return held.joint == joint && held.axis == axis; });
  if (motor.active() && motor.hold_rate > 0) held_.push_back({joint, axis, motor});
}

void HeldPoses::aim(double dt_s) const {
  for (const Held& held : held_) {
    aim_motor(joints_[held.joint], model_->joints[held.joint].kind, held.axis, held.motor, dt_s);
  }
}

}  // namespace pbmpi::ode
