/// Builds the rows of limits and motors from the poses of a joint's bodies.
#pragma once

#include "core/elementary.h"
#include "solver/joints/joint_controls.h"
#include "solver/joints/row_builder.h"

namespace pbmpi::solver {

/// Sine and cosine of half an angle, both times the same positive factor; c >= 0.
template <class V>
struct alignas(sizeof(V)) HalfAngle {
  V s, c;
};

/// The part of JointBuilder for limits and motors.
template <class T>
class ControlBuilder {
 public:
  using V = typename T::V;
  using Scalar = typename T::Scalar;
  using L3 = Vec3L<V>;
  using Pair = JointBodies<V>;

  ControlBuilder(const ControlRules<T>& rules, const RowBuilder<T>& rows, bool goes_on)
      : rules_(rules), rows_(rows), goes_on_(goes_on) {}

  /// Sets the row of a limit or motor about `axis`; half_angle(): the axis's current half angle, called only
  /// where it matters. Returns whether any lane has a row.
  template <class GetHalfAngle>
  bool set_axis_control(AxisControl<V>& control, const L3& axis, const GetHalfAngle& half_angle,
                        const Pair& pair, Bounded<AxisRow<V>, V>& row) const;
  void set_hinge_control(JointLane<V>& joint, const Pair& pair,
                         JointRows<T, model::JointKind::hinge>& rows) const;
  void set_slider_control(JointLane<V>& joint, const Pair& pair,
                          JointRows<T, model::JointKind::slider>& rows) const;

 private:
  /// 1 in the lanes whose axis is at or past a limit; the angle where it matters.
  struct AxisPlace {
    V at_low, at_high, angle;
  };
  template <class GetHalfAngle>
  AxisPlace locate(AxisControl<V>& control, const GetHalfAngle& half_angle) const;
  bool set_row(const AxisControl<V>& control, const L3& axis, const AxisPlace& place, const Pair& pair,
               Bounded<AxisRow<V>, V>& row) const;

  ControlRules<T> rules_;
  RowBuilder<T> rows_;
  bool goes_on_;
};

template <class T>
template <class GetHalfAngle>
bool ControlBuilder<T>::set_axis_control(AxisControl<V>& control, const L3& axis,
                                         const GetHalfAngle& half_angle, const Pair& pair,
                                         Bounded<AxisRow<V>, V>& row) const {
  return set_row(control, axis, locate(control, half_angle), pair, row);
}

/// The angle is that of ODE's getHingeAngle: from the quaternion of b relative to a, relative to the start.
template <class T>
void ControlBuilder<T>::set_hinge_control(JointLane<V>& joint, const Pair& pair,
                                          JointRows<T, model::JointKind::hinge>& rows) const {
  AxisControl<V>& control = joint.controls[0];
  rows.control_on[0] = control.any();
  if (!control.any()) return;
  const auto half_angle = [&]() -> HalfAngle<V> {
    const RelativeRotation<V> turn = relative_rotation(joint.terms, pair);
    const V zero = T::broadcast(0);
    const V length = T::sqrt(dot(turn.vector, turn.vector));
    const V along = dot(turn.vector, joint.terms.axis1_a);
    const V s = along >= zero ? -length : length;  // the angle of a relative to b
    return {turn.w < zero ? -s : s, T::abs(turn.w)};
  };
  rows.control_on[0] = set_axis_control(control, pair.a.rotation * joint.terms.axis1_a, half_angle, pair,
                                        rows.axis_controls[0]);
}

template <class T>
template <class GetHalfAngle>
typename ControlBuilder<T>::AxisPlace ControlBuilder<T>::locate(AxisControl<V>& control,
                                                                const GetHalfAngle& half_angle) const {
  const V zero = T::broadcast(0), one = T::broadcast(1);
  AxisPlace place{zero, zero, zero};
  if (!control.has_limit && !control.has_hold) return place;
  const HalfAngle<V> now = half_angle();
  if (control.has_limit) {
    place.at_low = now.s * control.cos_low <= now.c * control.sin_low ? one : zero;
    place.at_high = now.s * control.cos_high >= now.c * control.sin_high ? one : zero;
    place.at_high = place.at_low > zero ? zero : place.at_high;
  }
  if (control.has_hold || goes_on_ || T::any(place.at_low + place.at_high)) {
    place.angle = 2 * core::angle_of_right_half<T>(now.s, now.c);
    if (goes_on_) control.place = place.angle;
  }
  return place;
}

template <class T>
bool ControlBuilder<T>::set_row(const AxisControl<V>& control, const L3& axis, const AxisPlace& place,
                                const Pair& pair, Bounded<AxisRow<V>, V>& row) const {
  const auto& [at_low, at_high, angle] = place;
  const bool is_on = control.has_motor || T::any(at_low + at_high);
  if (!is_on && !goes_on_) return false;
  const auto state = rules_.decide(control, at_low, at_high, angle);
  rows_.set_axis(axis, state.rhs, pair, row.row);
  set_bounds(state, row);
  return is_on;
}

template <class T>
void ControlBuilder<T>::set_slider_control(JointLane<V>& joint, const Pair& pair,
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
  const auto state = rules_.decide(control, at_low, at_high, place);
  const L3 moment = cross(slider_arm<T>(pair, apart), axis);
  rows_.set_line(axis, moment, moment, state.rhs, T::broadcast(rows_.cfm()), pair, row.row);
  set_bounds(state, row);
}

}  // namespace pbmpi::solver
