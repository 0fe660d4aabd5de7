/// Builds the rows of a joint from the poses of its bodies.
#pragma once

#include "solver/joint_rows.h"
#include "solver/joint_terms.h"

namespace pbmpi::solver {

/// Two unit vectors across the unit vector n and each other (ODE's dPlaneSpace).
template <class T>
PBMPI_LANES void plane_space(const Vec3L<typename T::V>& n, Vec3L<typename T::V>& p,
                             Vec3L<typename T::V>& q) {
  using V = typename T::V;
  const auto steep = T::abs(n.z) > T::broadcast(static_cast<typename T::Scalar>(0.7071067811865475244));
  const V zero = T::broadcast(0);
  const V a = steep ? n.y * n.y + n.z * n.z : n.x * n.x + n.y * n.y;
  const V k = 1 / T::sqrt(a);
  p.x = steep ? zero : -n.y * k;
  p.y = steep ? -n.z * k : n.x * k;
  p.z = steep ? n.y * k : zero;
  q.x = steep ? a * k : -n.z * p.y;
  q.y = steep ? -n.x * p.z : n.z * p.x;
  q.z = steep ? n.x * p.y : a * k;
}

/// Uniform numbers of the substep, and what is built with them. later: of a substep after the first.
template <class T, bool later>
class JointBuilder {
 public:
  using V = typename T::V;
  using Scalar = typename T::Scalar;
  using L3 = Vec3L<V>;

  /// carry: the share of a row's impulse with which its next impulse starts in a later substep.
  JointBuilder(Scalar h, Scalar erp, Scalar cfm, Scalar sor_factor, Scalar carry)
      : h_(h), k_(erp / h), cfm_(cfm / h), factor_(sor_factor), carry_(carry) {}

  /// Rows from the poses. May add to the twists: a motor that is at its limit pushes as an external torque
  /// (ODE: dxJointLimitMotor::addLimot). Carried impulses have not acted on the twists yet. A later substep
  /// trusts the angles that advance_angles() has turned.
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
  /// What an axis does now: at a limit (with its error), driven, or nothing.
  struct ControlState {
    V rhs, low, high;  ///< of the row
    V push;            ///< impulse of a motor that is at its limit; acts on a against the axis
  };

  void set_point(const JointTermsLane<V>& terms, const Pair& pair, PointRows<V>& row) const;
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
  void set_slider_control(const JointLane<V>& joint, const Pair& pair,
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
  static AxisPlace locate(AxisControl<V>& control, GetHalfAngle half_angle);
  template <class GetHalfAngle>
  static AxisPlace locate_again(const AxisControl<V>& control, GetHalfAngle half_angle);
  /// A limit or motor on `axis`. Returns whether any lane has a row.
  bool set_axis_control(const AxisControl<V>& control, const L3& axis, const AxisPlace& place,
                        const Pair& pair, Bounded<AxisRow<V>, V>& row) const;
  /// The velocity at which a motor aims in this step, from the coordinate (0 where no lane holds a pose).
  V aim(const AxisControl<V>& control, const V& coordinate) const;
  /// at_low, at_high: 1 where the coordinate is at or past the limit, else 0; error: its distance from it;
  /// velocity: of the motor.
  ControlState decide(const AxisControl<V>& control, const V& at_low, const V& at_high, const V& error,
                      const V& velocity) const;
  static RelativeRotation relative_rotation(const JointTermsLane<V>& terms, const Pair& pair);
  PBMPI_LANES V carried(const V& impulse) const {
    if constexpr (!later) return T::broadcast(0);
    return carry_ > 0 ? impulse * T::broadcast(carry_) : T::broadcast(0);
  }
  template <class Row>
  static void set_bounds(const ControlState& state, Bounded<Row, V>& row) {
    row.low = state.low;
    row.high = state.high;
    if constexpr (later) row.row.impulse = T::min(T::max(row.row.impulse, state.low), state.high);
  }

  Scalar h_, k_, cfm_, factor_, carry_;
};

template <class T, bool later>
template <model::JointKind kind>
void JointBuilder<T, later>::build(JointLane<V>& joint, BodyLanes<T>& bodies,
                                   JointRows<T, kind>& rows) const {
  using model::JointKind;
  const Pair pair{bodies.bodies[joint.slot_a], bodies.bodies[joint.slot_b], bodies.twists[joint.slot_a],
                  bodies.twists[joint.slot_b]};
  rows.slot_a = joint.slot_a;
  rows.slot_b = joint.slot_b;
  rows.inv_mass_a = pair.a.inv_mass;
  rows.inv_mass_b = pair.b.inv_mass;
  if constexpr (row_counts(kind).points > 0) set_point(joint.terms, pair, rows.points[0]);
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

template <class T, bool later>
void JointBuilder<T, later>::set_point(const JointTermsLane<V>& terms, const Pair& pair,
                                       PointRows<V>& row) const {
  const auto& [a, b, twist_a, twist_b] = pair;
  row.arm_a = a.rotation * terms.anchor_a;
  row.arm_b = b.rotation * terms.anchor_b;
  const V zero = T::broadcast(0);
  const auto moments = [&](const L3& arm, int k) {  // arm x e_k
    return k == 0 ? L3{zero, arm.z, -arm.y} : (k == 1 ? L3{-arm.z, zero, arm.x} : L3{arm.y, -arm.x, zero});
  };
  V scale[3];
  for (int k = 0; k < 3; ++k) {
    const L3 moment_a = moments(row.arm_a, k), moment_b = moments(row.arm_b, k);
    row.turn_a[k] = a.inv_inertia * moment_a;
    row.turn_b[k] = b.inv_inertia * moment_b;
    const V diagonal = a.inv_mass + b.inv_mass + dot(moment_a, row.turn_a[k]) + dot(moment_b, row.turn_b[k]);
    scale[k] = factor_ / (diagonal + cfm_);
  }
  row.rhs = (b.position + row.arm_b - a.position - row.arm_a) * T::broadcast(k_);
  row.scale = {scale[0], scale[1], scale[2]};
  row.impulse = {carried(row.impulse.x), carried(row.impulse.y), carried(row.impulse.z)};
}

template <class T, bool later>
PBMPI_LANES void JointBuilder<T, later>::set_axis(const L3& axis, const V& rhs, const Pair& pair,
                                                  AxisRow<V>& row) const {
  row.axis = axis;
  row.turn_a = pair.a.inv_inertia * axis;
  row.turn_b = pair.b.inv_inertia * axis;
  row.rhs = rhs;
  row.scale = factor_ / (dot(axis, row.turn_a) + dot(axis, row.turn_b) + cfm_);
  row.impulse = carried(row.impulse);
}

template <class T, bool later>
PBMPI_LANES void JointBuilder<T, later>::set_line(const L3& direction, const L3& moment_a, const L3& moment_b,
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
  row.impulse = carried(row.impulse);
}

/// hinge2: the point held along axis 1 (softly, if sprung) and across it.
template <class T, bool later>
void JointBuilder<T, later>::set_suspended_point(const JointLane<V>& joint, const Pair& pair,
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
      const V total = h_ * terms.stiffness + terms.damping;  // ERP = h k / total, CFM = 1 / total
      k = terms.stiffness / total;
      cfm = 1 / (total * h_);
    }
    set_line(directions[i], cross(arm_a, directions[i]), -cross(arm_b, directions[i]),
             k * dot(directions[i], error), cfm, pair, rows[i]);
  }
}

template <class T, bool later>
void JointBuilder<T, later>::set_slider_lines(const JointTermsLane<V>& terms, const Pair& pair,
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
template <class T, bool later>
void JointBuilder<T, later>::set_parallel_axes(const JointTermsLane<V>& terms, const Pair& pair,
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
template <class T, bool later>
void JointBuilder<T, later>::set_orientation(const JointTermsLane<V>& terms, const Pair& pair,
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
template <class T, bool later>
template <model::JointKind kind>
void JointBuilder<T, later>::set_crossed_axes(JointLane<V>& joint, const Pair& pair,
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
template <class T, bool later>
void JointBuilder<T, later>::set_hinge_control(JointLane<V>& joint, const Pair& pair,
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

template <class T, bool later>
typename T::V JointBuilder<T, later>::aim(const AxisControl<V>& control, const V& coordinate) const {
  const V fastest = T::broadcast(1 / h_);
  return control.velocity - (control.hold_rate > fastest ? fastest : control.hold_rate) * coordinate;
}

template <class T, bool later>
typename JointBuilder<T, later>::ControlState JointBuilder<T, later>::decide(const AxisControl<V>& control,
                                                                             const V& at_low_flag,
                                                                             const V& at_high_flag,
                                                                             const V& error,
                                                                             const V& velocity) const {
  const V zero = T::broadcast(0);
  const V bound = T::broadcast(static_cast<Scalar>(huge_bound));
  const auto at_low = at_low_flag != zero;
  const auto at_high = at_high_flag != zero;
  const auto locked = control.low == control.high;
  const V force = control.max_force * h_;
  ControlState state;
  state.rhs = at_low ? -k_ * error : (at_high ? -k_ * error : velocity);
  state.low = at_low ? (locked ? -bound : zero) : (at_high ? -bound : -force);
  state.high = at_low ? bound : (at_high ? (locked ? bound : zero) : force);
  // A motor at its limit is a constant torque, into the limit unless the motor turns away from it.
  const V at_rest = at_low ? force : -force;
  const V push = velocity > zero ? -force : (velocity < zero ? force : at_rest);
  state.push = at_low ? push : (at_high ? push : zero);
  state.push = locked ? zero : state.push;
  return state;
}

template <class T, bool later>
template <class GetHalfAngle>
typename JointBuilder<T, later>::AxisPlace JointBuilder<T, later>::locate(AxisControl<V>& control,
                                                                          GetHalfAngle half_angle) {
  if constexpr (later) return locate_again(control, half_angle);
  const V zero = T::broadcast(0), one = T::broadcast(1);
  AxisPlace place{zero, zero, zero};
  if (!control.has_limit && !control.has_hold) return place;
  const HalfAngle now = half_angle();
  if (control.has_limit) {
    place.at_low = now.s * control.cos_low <= now.c * control.sin_low ? one : zero;
    place.at_high = now.s * control.cos_high >= now.c * control.sin_high ? one : zero;
    place.at_high = place.at_low > zero ? zero : place.at_high;
  }
  if (control.has_hold || T::any(place.at_low + place.at_high)) {
    place.angle = 2 * T::atan2(now.s, now.c);
    if (control.has_hold) control.held_angle = place.angle;
  }
  return place;
}

/// Lanes with a motor that holds a pose go by the angle that they keep; the others must not depend on what
/// their neighbours have.
template <class T, bool later>
template <class GetHalfAngle>
typename JointBuilder<T, later>::AxisPlace JointBuilder<T, later>::locate_again(const AxisControl<V>& control,
                                                                                GetHalfAngle half_angle) {
  const V zero = T::broadcast(0), one = T::broadcast(1);
  const V& held = control.held_angle;
  AxisPlace place{zero, zero, held};
  if (!control.has_limit && !control.has_hold) return place;
  const V rate = control.max_force > zero ? control.hold_rate : zero;
  const auto is_kept = rate > zero;
  const V kept = is_kept ? one : zero;
  if (control.has_limit) {
    place.at_low = held <= control.low ? kept : zero;
    place.at_high = held >= control.high ? kept : zero;
  }
  if (T::any(one - kept)) {
    const HalfAngle now = half_angle();
    if (control.has_limit) {
      const V at_low = now.s * control.cos_low <= now.c * control.sin_low ? one : zero;
      const V at_high = now.s * control.cos_high >= now.c * control.sin_high ? one : zero;
      place.at_low = is_kept ? place.at_low : at_low;
      place.at_high = is_kept ? place.at_high : at_high;
    }
    if (T::any(is_kept ? zero : place.at_low + place.at_high))
      place.angle = is_kept ? held : 2 * T::atan2(now.s, now.c);
  }
  place.at_high = place.at_low > zero ? zero : place.at_high;
  return place;
}

template <class T, bool later>
bool JointBuilder<T, later>::set_axis_control(const AxisControl<V>& control, const L3& axis,
                                              const AxisPlace& place, const Pair& pair,
                                              Bounded<AxisRow<V>, V>& row) const {
  const V zero = T::broadcast(0);
  const auto& [at_low, at_high, angle] = place;
  if (!control.has_motor && !T::any(at_low + at_high)) {
    row.row.impulse = zero;  // nothing for a later substep to carry
    return false;
  }
  const V velocity = control.has_hold ? aim(control, angle) : control.velocity;
  const V error = angle - (at_low > zero ? control.low : control.high);
  const ControlState state = decide(control, at_low, at_high, error, velocity);
  set_axis(axis, state.rhs, pair, row.row);
  set_bounds(state, row);
  pair.twist_a.angular = pair.twist_a.angular - row.row.turn_a * state.push;
  pair.twist_b.angular = pair.twist_b.angular + row.row.turn_b * state.push;
  return true;
}

template <class T, bool later>
void JointBuilder<T, later>::set_slider_control(const JointLane<V>& joint, const Pair& pair,
                                                JointRows<T, model::JointKind::slider>& rows) const {
  const AxisControl<V>& control = joint.controls[0];
  const V zero = T::broadcast(0), one = T::broadcast(1);
  const L3 axis = pair.a.rotation * joint.terms.axis1_a;
  const L3 apart = pair.b.position - pair.a.position;
  const V place = -dot(axis, apart + pair.b.rotation * joint.terms.anchor_b);
  const V at_low = place <= control.low ? one : zero;
  const V at_high = at_low > zero ? zero : (place >= control.high ? one : zero);
  auto& row = rows.line_controls[0];
  rows.control_on[0] = control.has_motor || T::any(at_low + at_high);
  if (!rows.control_on[0]) {
    row.row.impulse = zero;
    return;
  }
  const V velocity = control.has_hold ? aim(control, place) : control.velocity;
  const ControlState state =
      decide(control, at_low, at_high, place - (at_low > zero ? control.low : control.high), velocity);
  const L3 moment = cross(apart * T::broadcast(static_cast<Scalar>(0.5)), axis);
  set_line(axis, moment, moment, state.rhs, T::broadcast(cfm_), pair, row.row);
  set_bounds(state, row);
  pair.twist_a.linear = pair.twist_a.linear - axis * (pair.a.inv_mass * state.push);
  pair.twist_a.angular = pair.twist_a.angular - row.row.turn_a * state.push;
  pair.twist_b.linear = pair.twist_b.linear + axis * (pair.b.inv_mass * state.push);
  pair.twist_b.angular = pair.twist_b.angular - row.row.turn_b * state.push;
}

template <class T, bool later>
typename JointBuilder<T, later>::RelativeRotation JointBuilder<T, later>::relative_rotation(
    const JointTermsLane<V>& terms, const Pair& pair) {
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

/// Between two substeps, with the twists that have moved the bodies: turns the angles that motors look at as
/// the bodies have turned. Taken anew from the poses they would cost an arc tangent each, a tenth of the
/// step.
template <class T, model::JointKind kind>
PBMPI_LANES void advance_angles(JointLane<typename T::V>& joint, const BodyLanes<T>& bodies,
                                typename T::Scalar h, const JointRows<T, kind>& rows) {
  for (std::size_t i = 0; i < rows.axis_controls.size(); ++i) {
    if (!joint.controls[i].has_hold) continue;
    const auto relative = bodies.twists[rows.slot_a].angular - bodies.twists[rows.slot_b].angular;
    joint.controls[i].held_angle += h * dot(rows.axis_controls[i].row.axis, relative);
  }
}

}  // namespace pbmpi::solver
