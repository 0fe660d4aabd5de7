#include "mujoco/drives.h"

#include <algorithm>

#include "core/error.h"
#include "model/joint_traits.h"

namespace pbmpi::mujoco {
namespace {

using model::EventKind;

/// Stand-in [rad or m] for a limit on a side without one.
constexpr double far_away = 1e6;

/// Stand-in [N or N m] for the force of an unbounded motor.
constexpr double most_force = 1e9;

bool is_setting(const model::Event& event) {
  return event.kind == EventKind::motor || event.kind == EventKind::steer;
}

void require_drivable(const model::Model& model) {
  for (const model::Event& event : model.events) {
    if (!is_setting(event)) continue;
    const model::Joint& joint = model.joints[event.joint];
    const int axis = event.kind == EventKind::steer ? 0 : event.axis;
    core::require_input(model::traits_of(joint.kind).axes[axis].has_motor,
                        "event of step " + std::to_string(event.step) + ": joint '" + joint.name +
                            "' has no axis " + std::to_string(axis + 1) + " to drive; name another joint");
  }
}

/// Calls `found` with the body, the number and the axis for each joint axis that can be limited or driven.
template <class Found>
void for_each_axis(const std::vector<Link>& links, const Coordinates& at, Found&& found) {
  for (int body = 0; body < static_cast<int>(links.size()); ++body) {
    for (std::size_t k = 0; k < links[body].axes.size(); ++k) {
      const LinkAxis& axis = links[body].axes[k];
      if (axis.is_suspension || axis.freedom == Freedom::ball) continue;
      found(links[body].hold.joint, at.first_axis(body) + static_cast<int>(k), axis);
    }
  }
}

}  // namespace

Drives::Drives(const model::Model& model, std::int64_t step) : model_(&model) {
  require_drivable(model);
  for (const model::Joint& joint : model.joints) {
    motors_.push_back(joint.motors);
    limits_.push_back(joint.limits);
  }
  fire(step - 1);
}

bool Drives::fire(std::int64_t step) {
  bool any = false;
  for (; next_ < model_->events.size() && model_->events[next_].step <= step; ++next_)
    any = set(model_->events[next_]) || any;
  return any;
}

bool Drives::set(const model::Event& event) {
  if (event.kind == EventKind::motor) motors_[event.joint][event.axis] = event.motor;
  if (event.kind == EventKind::steer) limits_[event.joint][0] = {event.angle, event.angle};
  return is_setting(event);
}

void Drives::show(const std::vector<Link>& links, const Coordinates& at, const Constraints& constraints,
                  mjModel& compiled) const {
  for_each_axis(links, at, [&](int joint, int id, const LinkAxis& axis) {
    const model::AxisLimit& limit = limits_[joint][axis.axis];
    compiled.jnt_limited[id] = limit.active() && limit.low < limit.high ? 1 : 0;
    compiled.jnt_range[2 * id] = std::max(limit.low, -far_away);
    compiled.jnt_range[2 * id + 1] = std::min(limit.high, far_away);
    compiled.dof_frictionloss[compiled.jnt_dofadr[id]] =
        std::min(motors_[joint][axis.axis].max_force, most_force);
  });
  for (std::size_t i = 0; i < constraints.pins.size(); ++i) {
    const Pin& pin = constraints.pins[i];
    const model::AxisLimit& limit = limits_[pin.joint][pin.axis];
    compiled.eq_active[i] = limit.active() && limit.low >= limit.high ? 1 : 0;
    compiled.eq_data[mjNEQDATA * i] = compiled.eq_active[i] ? limit.low : 0;
  }
}

double Drives::target(const LinkAxis& axis, int joint, double coordinate, double dt_s) const {
  const model::AxisMotor& motor = motors_[joint][axis.axis];
  return motor.velocity - std::min(motor.hold_rate, 1 / dt_s) * coordinate;
}

/// The reference acceleration of a motor's row is -B v, with B the second element of efc_KBIP.
void Drives::aim(const std::vector<Link>& links, const Coordinates& at, const mjModel& compiled,
                 mjData& data) const {
  if (data.nf == 0) return;
  std::vector<double> targets(compiled.nv, 0);
  for_each_axis(links, at, [&](int joint, int id, const LinkAxis& axis) {
    targets[compiled.jnt_dofadr[id]] =
        target(axis, joint, data.qpos[compiled.jnt_qposadr[id]], compiled.opt.timestep);
  });
  for (int row = 0; row < data.nefc; ++row) {
    if (data.efc_type[row] != mjCNSTR_FRICTION_DOF) continue;
    data.efc_aref[row] += data.efc_KBIP[4 * row + 1] * targets[data.efc_id[row]];
  }
}

}  // namespace pbmpi::mujoco
