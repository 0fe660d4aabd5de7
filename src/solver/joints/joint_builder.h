/// Builds the rows of a joint from the poses of its bodies.
#pragma once

#include "solver/joints/joint_controls.h"
#include "solver/joints/joint_points.h"
#include "solver/lanes/plane_space.h"

namespace pbmpi::solver {

/// Uniform numbers of a step's first substep, and what is built with them. JointAdvancer leads the rows
/// through the substeps after it.
template <class T>
class JointBuilder {
 public:
  using V = typename T::V;
  using Scalar = typename T::Scalar;
  using L3 = Vec3L<V>;

  /// goes_on: there are substeps after this one, so that what they start from is built, too.
  JointBuilder(Scalar h, Scalar erp, Scalar cfm, Scalar sor_factor, bool goes_on)
      : controls_(h, erp), k_(erp / h), cfm_(cfm / h), factor_(sor_factor), goes_on_(goes_on) {}

  /// Rows from the poses. May add to the twists: see ControlRules::push().
  template <model::JointKind kind>
  void build(JointLane<V>& joint, BodyLanes<T>& bodies, JointRows<T, kind>& rows) const;

 private:
  /// Both bodies of the joint at hand.
  struct Pair {
    const BodyLane<V>&a, &b;
    Twist<V>&twist_a, &twist_b;
  };
  /// (q_a^-1 q_b) relative^-1: how b has turned against a since the start.
  struct RelativeRotation {
    V w;
    L3 vector;  ///< a's frame
  };
  PBMPI_LANES void set_axis(const L3& axis, const V& rhs, const Pair& pair, AxisRow<V>& row) const;
  PBMPI_LANES void set_line(const L3& direction, const L3& moment_a, const L3& moment_b, const V& rhs,
                            const V& cfm, const Pair& pair, LineRow<V>& row) const;
  void set_suspended_point(const JointLane<V>& joint, const Pair& pair, LineRow<V>* rows) const;
  void set_slider_lines(const JointTermsLane<V>& terms, const Pair& pair, LineRow<V>* rows) const;
  void set_parallel_axes(const JointTermsLane<V>& terms, const Pair& pair, AxisRow<V>* rows) const;
  void set_orientation(const JointTermsLane<V>& terms, const Pair& pair, AxisRow<V>* rows) const;
  template <model::JointKind kind>
  void set_crossed_axes(JointLane<V>& joint, const Pair& pair, JointRows<T, kind>& rows) const;
  void set_hinge_control(JointLane<V>& joint, const Pair& pair,
                         JointRows<T, model::JointKind::hinge>& rows) const;
  void set_slider_control(JointLane<V>& joint, const Pair& pair,
                          JointRows<T, model::JointKind::slider>& rows) const;
  /// Sine and cosine of half an angle, but for a factor; c >= 0.
  struct HalfAngle {
    V s, c;
  };
  /// 1 in the lanes whose axis is at a limit or past it; the angle where anybody looks at it.
  struct AxisPlace {
    V at_low, at_high, angle;
  };
  /// half_angle(): of the axis now.
  template <class GetHalfAngle>
  AxisPlace locate(AxisControl<V>& control, const GetHalfAngle& half_angle) const;
  /// A limit or motor on `axis`. Returns whether any lane has a row.
  bool set_axis_control(const AxisControl<V>& control, const L3& axis, const AxisPlace& place,
                        const Pair& pair, Bounded<AxisRow<V>, V>& row) const;
  static RelativeRotation relative_rotation(const JointTermsLane<V>& terms, const Pair& pair);

  ControlRules<T> controls_;
  Scalar k_, cfm_, factor_;
  bool goes_on_;
};

template <class T>
template <model::JointKind kind>
void JointBuilder<T>::build(JointLane<V>& joint, BodyLanes<T>& bodies, JointRows<T, kind>& rows) const {
  using model::JointKind;
  const Pair pair{bodies.bodies[joint.slot_a], bodies.bodies[joint.slot_b], bodies.twists[joint.slot_a],
                  bodies.twists[joint.slot_b]};
  rows.slot_a = joint.slot_a;
  rows.slot_b = joint.slot_b;
  rows.inv_mass_a = pair.a.inv_mass;
  rows.inv_mass_b = pair.b.inv_mass;
  for (PointRows<V>& point : rows.points) {
    build_point<T>(joint.terms, pair.a, pair.b, k_, point,
                   [&](const V& diagonal, const V&) { return factor_ / (diagonal + cfm_); });
    point.impulse = {T::broadcast(0), T::broadcast(0), T::broadcast(0)};
  }
  if constexpr (kind == JointKind::hinge) {
    set_parallel_axes(joint.terms, pair, rows.axes.data());
    set_hinge_control(joint, pair, rows);
  } else if constexpr (kind == JointKind::fixed) {
    set_orientation(joint.terms, pair, rows.axes.data());
  } else if constexpr (kind == JointKind::universal) {
    set_crossed_axes(joint, pair, rows);
  } else if constexpr (kind == JointKind::hinge2) {
    set_suspended_point(joint, pair, rows.lines.data());
    set_crossed_axes(joint, pair, rows);
  } else if constexpr (kind == JointKind::slider) {
    set_orientation(joint.terms, pair, rows.axes.data());
    set_slider_lines(joint.terms, pair, rows.lines.data());
    set_slider_control(joint, pair, rows);
  }
}

template <class T>
PBMPI_LANES void JointBuilder<T>::set_axis(const L3& axis, const V& rhs, const Pair& pair,
                                           AxisRow<V>& row) const {
  row.axis = axis;
  row.turn_a = pair.a.inv_inertia * axis;
  row.turn_b = pair.b.inv_inertia * axis;
  row.rhs = rhs;
  row.scale = factor_ / (dot(axis, row.turn_a) + dot(axis, row.turn_b) + cfm_);
  row.impulse = T::broadcast(0);
}

template <class T>
PBMPI_LANES void JointBuilder<T>::set_line(const L3& direction, const L3& moment_a, const L3& moment_b,
                                           const V& rhs, const V& cfm, const Pair& pair,
                                           LineRow<V>& row) const {
  row.direction = direction;
  row.moment_a = moment_a;
  row.moment_b = moment_b;
  row.turn_a = pair.a.inv_inertia * moment_a;
  row.turn_b = pair.b.inv_inertia * moment_b;
  row.rhs = rhs;
  row.cfm = cfm;
  row.scale = factor_ / (pair.a.inv_mass + pair.b.inv_mass + dot(moment_a, row.turn_a) +
                         dot(moment_b, row.turn_b) + cfm);
  row.impulse = T::broadcast(0);
}

/// hinge2: the point held along axis 1 (softly, if sprung) and across it.
template <class T>
void JointBuilder<T>::set_suspended_point(const JointLane<V>& joint, const Pair& pair,
                                          LineRow<V>* rows) const {
  const JointTermsLane<V>& terms = joint.terms;
  const L3 arm_a = pair.a.rotation * terms.anchor_a, arm_b = pair.b.rotation * terms.anchor_b;
  const L3 error = pair.b.position + arm_b - pair.a.position - arm_a;
  L3 directions[3];
  directions[0] = pair.a.rotation * terms.axis1_a;
  plane_space<T>(directions[0], directions[1], directions[2]);
  for (int i = 0; i < 3; ++i) {
    V k = T::broadcast(k_), cfm = T::broadcast(cfm_);
    if (i == 0 && joint.sprung) {
      const V total = controls_.h() * terms.stiffness + terms.damping;  // ERP = h k / total, CFM = 1 / total
      k = terms.stiffness / total;
      cfm = 1 / (total * controls_.h());
    }
    set_line(directions[i], cross(arm_a, directions[i]), -cross(arm_b, directions[i]),
             k * dot(directions[i], error), cfm, pair, rows[i]);
  }
}

template <class T>
void JointBuilder<T>::set_slider_lines(const JointTermsLane<V>& terms, const Pair& pair,
                                       LineRow<V>* rows) const {
  const L3 axis = pair.a.rotation * terms.axis1_a;
  const L3 apart = pair.b.position - pair.a.position;
  const L3 error = apart + pair.b.rotation * terms.anchor_b;
  L3 directions[2];
  plane_space<T>(axis, directions[0], directions[1]);
  const V half = T::broadcast(static_cast<Scalar>(0.5));
  for (int i = 0; i < 2; ++i) {
    const L3 moment = cross(apart, directions[i]) * half;
    set_line(directions[i], moment, moment, k_ * dot(directions[i], error), T::broadcast(cfm_), pair,
             rows[i]);
  }
}

/// hinge: the two axes 1 stay parallel.
template <class T>
void JointBuilder<T>::set_parallel_axes(const JointTermsLane<V>& terms, const Pair& pair,
                                        AxisRow<V>* rows) const {
  const L3 axis_a = pair.a.rotation * terms.axis1_a;
  const L3 error = cross(axis_a, pair.b.rotation * terms.axis1_b);
  L3 p, q;
  plane_space<T>(axis_a, p, q);
  set_axis(p, k_ * dot(error, p), pair, rows[0]);
  set_axis(q, k_ * dot(error, q), pair, rows[1]);
}

/// fixed, slider: the whole relative orientation stays. The vector part of the relative rotation is half the
/// error, in a's frame (ODE: setFixedOrientation).
template <class T>
void JointBuilder<T>::set_orientation(const JointTermsLane<V>& terms, const Pair& pair,
                                      AxisRow<V>* rows) const {
  const RelativeRotation turn = relative_rotation(terms, pair);
  const V zero = T::broadcast(0), one = T::broadcast(1);
  const V sign = turn.w < zero ? -one : one;
  const L3 error = pair.a.rotation * (turn.vector * sign);
  const V twice = T::broadcast(2 * k_);
  set_axis({one, zero, zero}, twice * error.x, pair, rows[0]);
  set_axis({zero, one, zero}, twice * error.y, pair, rows[1]);
  set_axis({zero, zero, one}, twice * error.z, pair, rows[2]);
}

/// universal, hinge2: an axis fixed in each body.
template <class T>
template <model::JointKind kind>
void JointBuilder<T>::set_crossed_axes(JointLane<V>& joint, const Pair& pair,
                                       JointRows<T, kind>& rows) const {
  const JointTermsLane<V>& terms = joint.terms;
  const L3 axis1 = pair.a.rotation * terms.axis1_a, axis2 = pair.b.rotation * terms.axis2_b;
  const L3 crossed = cross(axis1, axis2);
  const V sine = T::sqrt(dot(crossed, crossed));
  const V cosine = dot(axis1, axis2);
  // universal: the axes stay at right angles; hinge2: at the angle of the start. cos0 is 0 for ODE's
  // universal.
  const V rhs =
      kind == model::JointKind::universal ? -k_ * cosine : k_ * (terms.cos0 * sine - terms.sin0 * cosine);
  set_axis(crossed * (1 / sine), rhs, pair, rows.axes[0]);
  for (int i = 0; i < 2; ++i) {
    AxisControl<V>& control = joint.controls[i];
    rows.control_on[i] = control.any();
    if (!control.any()) continue;
    // Angle 1: where a sees axis 2 turned about its axis 1. Angle 2: where b sees axis 1 turned about its
    // axis 2.
    const L3& axis = i == 0 ? axis1 : axis2;
    const auto half_angle = [&]() -> HalfAngle {
      const L3 normal = i == 0 ? pair.a.rotation * terms.normal1_a : pair.b.rotation * terms.normal2_b;
      const L3& seen = i == 0 ? axis2 : axis1;
      const V x = dot(seen, normal);
      const V y = dot(seen, cross(axis, normal));
      const V c = T::sqrt(x * x + y * y) + x;
      return {i == 0 ? -y : y, c};
    };
    rows.control_on[i] =
        set_axis_control(control, axis, locate(control, half_angle), pair, rows.axis_controls[i]);
  }
}

/// The angle as ODE's getHingeAngle has it: from the quaternion of b relative to a relative to the start.
template <class T>
void JointBuilder<T>::set_hinge_control(JointLane<V>& joint, const Pair& pair,
                                        JointRows<T, model::JointKind::hinge>& rows) const {
  AxisControl<V>& control = joint.controls[0];
  rows.control_on[0] = control.any();
  if (!control.any()) return;
  const auto half_angle = [&]() -> HalfAngle {
    const RelativeRotation turn = relative_rotation(joint.terms, pair);
    const V zero = T::broadcast(0);
    const V length = T::sqrt(dot(turn.vector, turn.vector));
    const V along = dot(turn.vector, joint.terms.axis1_a);
    const V s = along >= zero ? -length : length;  // the angle of a relative to b
    return {turn.w < zero ? -s : s, T::abs(turn.w)};
  };
  rows.control_on[0] = set_axis_control(control, pair.a.rotation * joint.terms.axis1_a,
                                        locate(control, half_angle), pair, rows.axis_controls[0]);
}

template <class T>
template <class GetHalfAngle>
typename JointBuilder<T>::AxisPlace JointBuilder<T>::locate(AxisControl<V>& control,
                                                            const GetHalfAngle& half_angle) const {
  const V zero = T::broadcast(0), one = T::broadcast(1);
  AxisPlace place{zero, zero, zero};
  if (!control.has_limit && !control.has_hold) return place;
  const HalfAngle now = half_angle();
  if (control.has_limit) {
    place.at_low = now.s * control.cos_low <= now.c * control.sin_low ? one : zero;
    place.at_high = now.s * control.cos_high >= now.c * control.sin_high ? one : zero;
    place.at_high = place.at_low > zero ? zero : place.at_high;
  }
  if (control.has_hold || goes_on_ || T::any(place.at_low + place.at_high)) {
    place.angle = 2 * T::atan2(now.s, now.c);
    if (goes_on_) control.place = place.angle;
  }
  return place;
}

template <class T>
bool JointBuilder<T>::set_axis_control(const AxisControl<V>& control, const L3& axis, const AxisPlace& place,
                                       const Pair& pair, Bounded<AxisRow<V>, V>& row) const {
  const auto& [at_low, at_high, angle] = place;
  const bool is_on = control.has_motor || T::any(at_low + at_high);
  if (!is_on && !goes_on_) return false;
  const auto state = controls_.decide(control, at_low, at_high, angle);
  set_axis(axis, state.rhs, pair, row.row);
  set_bounds(state, row);
  if (is_on) controls_.push(row.row, state.push, pair.twist_a, pair.twist_b);
  return is_on;
}

template <class T>
void JointBuilder<T>::set_slider_control(JointLane<V>& joint, const Pair& pair,
                                         JointRows<T, model::JointKind::slider>& rows) const {
  AxisControl<V>& control = joint.controls[0];
  const V zero = T::broadcast(0), one = T::broadcast(1);
  const L3 axis = pair.a.rotation * joint.terms.axis1_a;
  const L3 apart = pair.b.position - pair.a.position;
  const V place = -dot(axis, apart + pair.b.rotation * joint.terms.anchor_b);
  const V at_low = place <= control.low ? one : zero;
  const V at_high = at_low > zero ? zero : (place >= control.high ? one : zero);
  if (goes_on_) control.place = place;
  auto& row = rows.line_controls[0];
  rows.control_on[0] = control.has_motor || T::any(at_low + at_high);
  if (!rows.control_on[0] && !goes_on_) return;
  const auto state = controls_.decide(control, at_low, at_high, place);
  const L3 moment = cross(apart * T::broadcast(static_cast<Scalar>(0.5)), axis);
  set_line(axis, moment, moment, state.rhs, T::broadcast(cfm_), pair, row.row);
  set_bounds(state, row);
  if (rows.control_on[0])
    controls_.push(row.row, state.push, rows.inv_mass_a, rows.inv_mass_b, pair.twist_a, pair.twist_b);
}

template <class T>
typename JointBuilder<T>::RelativeRotation JointBuilder<T>::relative_rotation(const JointTermsLane<V>& terms,
                                                                              const Pair& pair) {
  const auto& [a, b, twist_a, twist_b] = pair;
  const V rw = a.qw * b.qw + a.qx * b.qx + a.qy * b.qy + a.qz * b.qz;
  const V rx = a.qw * b.qx - a.qx * b.qw - a.qy * b.qz + a.qz * b.qy;
  const V ry = a.qw * b.qy - a.qy * b.qw - a.qz * b.qx + a.qx * b.qz;
  const V rz = a.qw * b.qz - a.qz * b.qw - a.qx * b.qy + a.qy * b.qx;
  const V &sw = terms.relative_w, &sx = terms.relative_x, &sy = terms.relative_y, &sz = terms.relative_z;
  return {rw * sw + rx * sx + ry * sy + rz * sz,
          {rx * sw - rw * sx - ry * sz + rz * sy, ry * sw - rw * sy - rz * sx + rx * sz,
           rz * sw - rw * sz - rx * sy + ry * sx}};
}

}  // namespace pbmpi::solver
