/// Writes plain numbers into one lane of a pack's data.
#pragma once

#include <numbers>

#include "core/elementary.h"
#include "geometry/geometry.h"
#include "model/step_memory.h"
#include "solver/joints/joint_terms.h"
#include "solver/layout/body_lanes.h"

namespace pbmpi::solver {

template <class T>
struct SetLanes {
  using V = typename T::V;
  using Scalar = typename T::Scalar;

  static void set(V& v, int lane, double value) { T::set(v, lane, static_cast<Scalar>(value)); }
  static void set(Vec3L<V>& v, int lane, const model::Vec3& value) {
    set(v.x, lane, value.x());
    set(v.y, lane, value.y());
    set(v.z, lane, value.z());
  }
  /// The upper triangle of a symmetric matrix.
  static void set(Sym3L<V>& s, int lane, const model::Mat3& m) {
    set(s.xx, lane, m(0, 0));
    set(s.xy, lane, m(0, 1));
    set(s.xz, lane, m(0, 2));
    set(s.yy, lane, m(1, 1));
    set(s.yz, lane, m(1, 2));
    set(s.zz, lane, m(2, 2));
  }
  /// Sets position and quaternion; refresh() computes the rest from them.
  static void set(BodyLane<V>& body, int lane, const model::Pose& pose) {
    set(body.position, lane, pose.position);
    const model::Vec3 rounded = pose.position.cast<Scalar>().template cast<double>();
    set(body.position_low, lane, pose.position - rounded);
    set(body.qw, lane, pose.orientation.w);
    set(body.qx, lane, pose.orientation.x);
    set(body.qy, lane, pose.orientation.y);
    set(body.qz, lane, pose.orientation.z);
  }
  static void set(JointTermsLane<V>& to, int lane, const JointTerms& terms) {
    set(to.anchor_a, lane, terms.anchor_a);
    set(to.anchor_b, lane, terms.anchor_b);
    set(to.axis1_a, lane, terms.axis1_a);
    set(to.axis1_b, lane, terms.axis1_b);
    set(to.axis2_b, lane, terms.axis2_b);
    set(to.normal1_a, lane, terms.normal1_a);
    set(to.normal2_b, lane, terms.normal2_b);
    set(to.relative_w, lane, terms.relative.w);
    set(to.relative_x, lane, terms.relative.x);
    set(to.relative_y, lane, terms.relative.y);
    set(to.relative_z, lane, terms.relative.z);
    set(to.cos0, lane, terms.cos0);
    set(to.sin0, lane, terms.sin0);
    set(to.stiffness, lane, terms.stiffness);
    set(to.damping, lane, terms.damping);
  }
  static void set(JointForceLane<V>& to, int lane, const model::JointForce& force) {
    set(to.force, lane, force.force);
    set(to.torque, lane, force.torque);
    for (int axis = 0; axis < 2; ++axis) {
      set(to.control[axis], lane, force.control[axis]);
      set(to.rotor[axis], lane, force.rotor[axis]);
      set(to.angle[axis], lane, force.angle[axis]);
    }
  }
  static void set(AxisControl<V>& control, int lane, const model::AxisMotor& motor) {
    set(control.velocity, lane, motor.velocity);
    set(control.max_force, lane, motor.max_force);
    set(control.hold_rate, lane, motor.hold_rate);
    control.has_motor = control.has_motor || motor.active();
    control.has_hold = control.has_hold || (motor.active() && motor.hold_rate > 0);
  }
  /// A range of nearly a whole turn, or with one limit only, does not tell by an angle on which side of it a
  /// joint is: turns are counted. `half_a_radian` is more than any limit gives.
  static void set(AxisControl<V>& control, int lane, const model::AxisLimit& limit) {
    constexpr double half_a_radian = 0.5;
    const bool low = limit.low > -model::infinity, high = limit.high < model::infinity;
    const bool counts = limit.active() && !(limit.high - limit.low < 2 * (std::numbers::pi - half_a_radian));
    const bool has_middle = limit.active() && !counts;
    const double middle = has_middle ? (limit.low + limit.high) / 2 : 0;
    set(control.low, lane, low ? limit.low : -huge_bound);
    set(control.high, lane, high ? limit.high : huge_bound);
    set(control.middle, lane, middle);
    set(control.sin_middle, lane, core::sine(middle / 2));
    set(control.cos_middle, lane, core::cosine(middle / 2));
    set(control.counts, lane, counts ? 1 : 0);
    control.has_limit = control.has_limit || limit.active();
    control.counts_turns = control.counts_turns || counts;
  }
  static void set_armature(AxisControl<V>& control, int lane, double armature) {
    set(control.armature, lane, armature);
    control.has_rotor = control.has_rotor || armature > 0;
  }
};

}  // namespace pbmpi::solver
