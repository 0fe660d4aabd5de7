#include "ode/objects/events.h"

#include "core/error.h"
#include "model/joint_traits.h"
#include "ode/objects/joints.h"
#include "ode/objects/numbers.h"

namespace pbmpi::ode {
namespace {

/// ODE normalises the quaternion in the same way each time, so a restart before or after the launch changes
/// nothing.
void place(dBodyID body, const model::Pose& pose) {
  dBodySetPosition(body, pose.position.x(), pose.position.y(), pose.position.z());
  const dQuaternion q = {real(pose.orientation.w), real(pose.orientation.x), real(pose.orientation.y),
                         real(pose.orientation.z)};
  dBodySetQuaternion(body, q);
}

/// Is it a setting of a joint's axis? Releases are handled by effects::Breakage.
bool is_setting(const model::Event& event) {
  return event.kind == model::EventKind::motor || event.kind == model::EventKind::steer;
}

void require_drivable(const model::Model& model) {
  for (const model::Event& event : model.events) {
    if (!is_setting(event)) continue;
    const model::Joint& joint = model.joints[event.joint];
    const int axis = event.kind == model::EventKind::steer ? 0 : event.axis;
    core::require_input(model::traits_of(joint.kind).axes[axis].has_motor,
                        "event of step " + std::to_string(event.step) + ": joint '" + joint.name +
                            "' has no axis " + std::to_string(axis + 1) + " to drive; name another joint");
  }
}

}  // namespace

Events::Events(const model::Model& model, const std::vector<dBodyID>& bodies,
               const std::vector<dJointID>& joints, HeldPoses& poses)
    : model_(&model), bodies_(bodies), joints_(joints), poses_(&poses) {
  require_drivable(model);
}

void Events::skip_to(std::int64_t step) {
  for (; next_ < model_->events.size() && model_->events[next_].step < step; ++next_) {
    const model::Event& event = model_->events[next_];
    if (is_setting(event)) set_joint(event);
  }
}

void Events::apply(const model::Event& event) {
  if (is_setting(event)) set_joint(event);
  if (event.kind != model::EventKind::launch) return;
  const dBodyID body = bodies_[event.body];
  if (event.pose) place(body, *event.pose);
  dBodySetLinearVel(body, event.velocity.x(), event.velocity.y(), event.velocity.z());
  dBodySetAngularVel(body, event.angular_velocity.x(), event.angular_velocity.y(),
                     event.angular_velocity.z());
}

void Events::set_motor(int joint, int axis, const model::AxisMotor& motor) {
  ode::set_motor(joints_[joint], model_->joints[joint].kind, axis, motor);
  poses_->replace(joint, axis, motor);
}

void Events::set_joint(const model::Event& event) {
  if (event.kind == model::EventKind::motor) {
    set_motor(event.joint, event.axis, event.motor);
  } else {
    set_limit(joints_[event.joint], model_->joints[event.joint].kind, 0, {event.angle, event.angle});
  }
}

}  // namespace pbmpi::ode
