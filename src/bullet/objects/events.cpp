#include "bullet/objects/events.h"

#include "core/error.h"
#include "model/joint_traits.h"

namespace pbmpi::bullet {
namespace {

/// Is it a setting of a joint's axis? Releases are handled by effects::Breakage.
bool is_setting(const model::Event& event) {
  return event.kind == model::EventKind::motor || event.kind == model::EventKind::steer;
}

void require_drivable(const model::Model& model) {
  for (const model::Event& event : model.events) {
    if (!is_setting(event)) continue;
    const model::Joint& joint = model.joints[static_cast<std::size_t>(event.joint)];
    const int axis = event.kind == model::EventKind::steer ? 0 : event.axis;
    core::require_input(model::traits_of(joint.kind).axes[static_cast<std::size_t>(axis)].has_motor,
                        "event of step " + std::to_string(event.step) + ": joint '" + joint.name +
                            "' has no axis " + std::to_string(axis + 1) + " to drive; name another joint");
  }
}

}  // namespace

Events::Events(const model::Model& model, Bodies& bodies, AxisJoints& joints, HeldPoses& poses)
    : model_(&model), bodies_(&bodies), joints_(&joints), poses_(&poses) {
  require_drivable(model);
}

void Events::skip_to(std::int64_t step) {
  for (; next_ < model_->events.size() && model_->events[next_].step < step; ++next_) {
    const model::Event& event = model_->events[next_];
    if (is_setting(event)) set_joint(event);
  }
}

void Events::fire(std::int64_t step) {
  while (next_ < model_->events.size() && model_->events[next_].step <= step) apply(model_->events[next_++]);
}

void Events::apply(const model::Event& event) {
  if (is_setting(event)) set_joint(event);
  if (event.kind != model::EventKind::launch) return;
  if (event.pose) bodies_->place(event.body, event.pose->position, event.pose->orientation);
  bodies_->set_velocity(event.body, event.velocity, event.angular_velocity);
}

void Events::set_motor(int joint, int axis, const model::AxisMotor& motor) {
  joints_->set_motor(joint, axis, motor);
  poses_->replace(joint, axis, motor);
}

void Events::set_joint(const model::Event& event) {
  if (event.kind == model::EventKind::motor) {
    set_motor(event.joint, event.axis, event.motor);
  } else {
    joints_->set_limit(event.joint, 0, {event.angle, event.angle});
  }
}

}  // namespace pbmpi::bullet
