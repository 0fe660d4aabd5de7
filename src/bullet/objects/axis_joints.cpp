#include "bullet/objects/axis_joints.h"

#include <algorithm>
#include <numbers>

#include "model/joint_traits.h"
#include "model/validate.h"

namespace pbmpi::bullet {
namespace {

using model::JointTraits;
using Constraint = btGeneric6DofSpring2Constraint;

/// Bullet's numbers of a constraint's axes.
constexpr int line_z = 2, turn_x = 3, turn_y = 4, turn_z = 5, num_axes = 6;

void free_axis(Constraint& constraint, int axis) { constraint.setLimit(axis, 1, -1); }

/// Bullet's axis for a model axis: axis 1 is about or along z, axis 2 about x.
int bullet_axis(const JointTraits& traits, int axis) {
  if (axis == 1) return turn_x;
  return traits.slides ? line_z : turn_z;
}

void hold(const model::Joint& joint, double erp, Constraint& constraint) {
  const JointTraits& traits = model::traits_of(joint.kind);
  for (int axis = 0; axis < num_axes; ++axis) {
    constraint.setLimit(axis, 0, 0);
    constraint.setParam(BT_CONSTRAINT_STOP_ERP, erp, axis);
  }
  if (traits.turn == model::HeldTurn::nothing) {
    for (const int axis : {turn_x, turn_y, turn_z}) free_axis(constraint, axis);
  }
  for (int axis = 0; axis < traits.num_axes; ++axis) free_axis(constraint, bullet_axis(traits, axis));
}

/// Uses Bullet's own spring along axis 1. Bullet keeps stiffness and damping below the limit at which the
/// explicit spring of a step is stable ("limitIfNeeded" of btGeneric6DofSpring2Constraint).
void suspend(const model::Joint& joint, Constraint& constraint) {
  if (!model::traits_of(joint.kind).has_suspension() || !(joint.suspension.stiffness > 0)) return;
  free_axis(constraint, line_z);
  constraint.enableSpring(line_z, true);
  constraint.setStiffness(line_z, joint.suspension.stiffness);
  constraint.setDamping(line_z, joint.suspension.damping);
  constraint.setEquilibriumPoint(line_z, 0);
}

}  // namespace

AxisJoints::AxisJoints(const model::Model& model, Bodies& bodies) : model_(&model) {
  for (const model::Joint& joint : model.joints) {
    const JointFrames frames = frames_of(model, joint, bodies);
    joints_.push_back(std::make_unique<Constraint>(bodies.get(joint.body_a), bodies.get(joint.body_b),
                                                   frames.a, frames.b, RO_XYZ));
    Constraint& constraint = *joints_.back();
    hold(joint, model.erp, constraint);
    if (model::traits_of(joint.kind).turn == model::HeldTurn::start_angle) {
      constraint.calculateTransforms();  // the bodies are at their initial poses
      constraint.setLimit(turn_y, constraint.getAngle(1), constraint.getAngle(1));
    }
    suspend(joint, constraint);
    const int index = size() - 1;
    if (model::moves_along_axis(joint))
      sliding_.push_back({index, constraint.getFrameOffsetA().getOrigin(), 0, {}});
    for (int axis = 0; axis < 2; ++axis) {
      const auto at = static_cast<std::size_t>(axis);
      if (joint.limits[at].active()) set_limit(index, axis, joint.limits[at]);
      if (joint.motors[at].active()) set_motor(index, axis, joint.motors[at]);
    }
  }
}

AxisJoints::Sliding* AxisJoints::find_sliding(int joint) {
  const auto found = std::ranges::find(sliding_, joint, &Sliding::joint);
  return found == sliding_.end() ? nullptr : &*found;
}

void AxisJoints::follow() {
  for (Sliding& sliding : sliding_) {
    Constraint& constraint = (*this)[sliding.joint];
    btTransform& frame = constraint.getFrameOffsetA();
    frame.setOrigin(sliding.origin);
    constraint.calculateTransforms();
    sliding.way = constraint.getRelativePivotPosition(line_z);
    frame.setOrigin(sliding.origin + sliding.way * frame.getBasis().getColumn(2));
    constraint.setEquilibriumPoint(line_z, -sliding.way);
    limit_sliding(sliding);
  }
}

void AxisJoints::limit_sliding(const Sliding& sliding) {
  if (!sliding.limit.active()) return;
  const btScalar most = 1e30;
  (*this)[sliding.joint].setLimit(line_z, std::clamp(sliding.limit.low - sliding.way, -most, most),
                                  std::clamp(sliding.limit.high - sliding.way, -most, most));
}

void AxisJoints::set_motor(int joint, int axis, const model::AxisMotor& motor) {
  Constraint& constraint = (*this)[joint];
  const JointTraits& traits = model::traits_of(model_->joints[static_cast<std::size_t>(joint)].kind);
  const int at = bullet_axis(traits, axis);
  constraint.enableMotor(at, motor.active());
  // Along a line Bullet's motor drives a relative to b, while its coordinate is that of b relative to a.
  constraint.setTargetVelocity(at, traits.slides ? -motor.velocity : motor.velocity);
  constraint.setMaxMotorForce(at, motor.max_force);
}

/// A stop of an angle beyond half a turn has no effect, as in ODE.
void AxisJoints::set_limit(int joint, int axis, const model::AxisLimit& limit) {
  Constraint& constraint = (*this)[joint];
  const JointTraits& traits = model::traits_of(model_->joints[static_cast<std::size_t>(joint)].kind);
  const int at = bullet_axis(traits, axis);
  if (traits.slides) {
    Sliding& sliding = *find_sliding(joint);
    sliding.limit = limit;
    return limit_sliding(sliding);
  }
  const double reach = std::numbers::pi;
  if (limit.low <= -reach && limit.high >= reach) return free_axis(constraint, at);
  constraint.setLimit(at, std::clamp(limit.low, -reach, reach), std::clamp(limit.high, -reach, reach));
}

double AxisJoints::coordinate(int joint, int axis) {
  Constraint& constraint = (*this)[joint];
  const JointTraits& traits = model::traits_of(model_->joints[static_cast<std::size_t>(joint)].kind);
  const int at = bullet_axis(traits, axis);
  constraint.calculateTransforms();
  if (at == line_z) return constraint.getRelativePivotPosition(line_z) + find_sliding(joint)->way;
  return constraint.getAngle(at - turn_x);
}

int AxisJoints::count_rows(int joint) {
  btTypedConstraint::btConstraintInfo1 info{};
  (*this)[joint].getInfo1(&info);
  return info.m_numConstraintRows;
}

}  // namespace pbmpi::bullet
