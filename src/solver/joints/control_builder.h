/// Builds the rows of limits and motors from the poses of a joint's bodies.
#pragma once

#include <limits>
#include <numbers>

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

  ControlBuilder(const ControlRules<T>& rules, const RowBuilder<T>& rows) : rules_(rules), rows_(rows) {}

  /// Sets the row of a limit, motor or rotor about `axis`; half_angle(): the axis's current half angle,
  /// called only where it matters. Returns whether any lane has a limit or motor that acts.
  template <class GetHalfAngle>
  bool set_axis_control(AxisControl<V>& control, const L3& axis, const GetHalfAngle& half_angle,
                        const Pair& pair, Bounded<AxisRow<V>, V>& row) const;
  void set_hinge_control(JointLane<V>& joint, const Pair& pair,
                         JointRows<T, model::JointKind::hinge>& rows) const;
  void set_slider_control(JointLane<V>& joint, const Pair& pair,
                          JointRows<T, model::JointKind::slider>& rows) const;

 private:
  /// 1 in the lanes whose axis is at or past a limit; the coordinate where it matters.
  struct AxisPlace {
    V at_low, at_high, angle;
  };
  template <class GetHalfAngle>
  AxisPlace locate(AxisControl<V>& control, const GetHalfAngle& half_angle) const;
  /// A driven axis meets its limit only when it is there.
  void set_limits(const AxisControl<V>& control, AxisPlace& place) const {
    const V zero = T::broadcast(0), one = T::broadcast(1);
    const V margin = control.max_force > zero ? zero : T::broadcast(rules_.margin());
    place.at_low = place.angle <= control.low + margin ? one : zero;
    place.at_high = place.at_low > zero ? zero : (place.angle >= control.high - margin ? one : zero);
  }
  /// Puts lanes right whose turns are counted.
  void count_turns(AxisControl<V>& control, const HalfAngle<V>& now, AxisPlace& place) const;
  static bool has_row(const AxisControl<V>& control, const AxisPlace& place) {
    return control.has_motor || T::any(place.at_low + place.at_high);
  }
  template <class Row>
  void set_bounds(const AxisControl<V>& control, const AxisPlace& place, Row& row) const {
    row.rotor.inertia = control.armature;
    row.set(rules_.decide(control, place.at_low, place.at_high, place.angle));
  }

  ControlRules<T> rules_;
  RowBuilder<T> rows_;
};

template <class T>
template <class GetHalfAngle>
bool ControlBuilder<T>::set_axis_control(AxisControl<V>& control, const L3& axis,
                                         const GetHalfAngle& half_angle, const Pair& pair,
                                         Bounded<AxisRow<V>, V>& row) const {
  AxisPlace place{T::broadcast(0), T::broadcast(0), T::broadcast(0)};
  if (control.has_limit || control.has_hold) place = locate(control, half_angle);
  const bool is_on = has_row(control, place);
  if (!is_on && !control.has_rotor) return false;
  rows_.set_axis(axis, T::broadcast(0), pair, row.row);
  set_bounds(control, place, row);
  return is_on;
}

/// The angle is that of ODE's getHingeAngle: from the quaternion of b relative to a, relative to the start.
template <class T>
void ControlBuilder<T>::set_hinge_control(JointLane<V>& joint, const Pair& pair,
                                          JointRows<T, model::JointKind::hinge>& rows) const {
  const auto half_angle = [&]() -> HalfAngle<V> {
    const RelativeRotation<V> turn = relative_rotation(joint.terms, pair);
    const V zero = T::broadcast(0);
    const V length = T::sqrt(dot(turn.vector, turn.vector));
    const V along = dot(turn.vector, joint.terms.axis1_a);
    const V s = along >= zero ? -length : length;  // the angle of a relative to b
    return {turn.w < zero ? -s : s, T::abs(turn.w)};
  };
  rows.control_on[0] = set_axis_control(joint.controls[0], pair.a.rotation * joint.terms.axis1_a, half_angle,
                                        pair, rows.axis_controls[0]);
}

/// A range of less than a turn is recognised by the angle from its middle. Beyond a limit the angle so
/// belongs to the nearer one.
template <class T>
template <class GetHalfAngle>
typename ControlBuilder<T>::AxisPlace ControlBuilder<T>::locate(AxisControl<V>& control,
                                                                const GetHalfAngle& half_angle) const {
  const V zero = T::broadcast(0);
  AxisPlace place{zero, zero, zero};
  const HalfAngle<V> now = half_angle();
  const V s = now.s * control.cos_middle - now.c * control.sin_middle;
  const V c = now.c * control.cos_middle + now.s * control.sin_middle;
  const HalfAngle<V> away{c < zero ? -s : s, T::abs(c)};
  place.angle = control.middle + 2 * core::angle_of_right_half<T>(away.s, away.c);
  if (control.counts_turns) count_turns(control, now, place);
  set_limits(control, place);
  return place;
}

/// The angle so far tells which turn it is, as an axis turns by less than half of one from look to look.
/// Adding and subtracting 1.5 / epsilon rounds to whole numbers.
template <class T>
void ControlBuilder<T>::count_turns(AxisControl<V>& control, const HalfAngle<V>& now,
                                    AxisPlace& place) const {
  const V zero = T::broadcast(0);
  constexpr Scalar turn = 2 * std::numbers::pi_v<Scalar>,
                   rounding = Scalar{1.5} / std::numeric_limits<Scalar>::epsilon();
  const V angle = 2 * core::angle_of_right_half<T>(now.s, now.c);
  const V turns =
      ((control.angle - angle) * T::broadcast(1 / turn) + T::broadcast(rounding)) - T::broadcast(rounding);
  const auto counts = control.counts > zero;
  control.angle = counts ? angle + T::broadcast(turn) * turns : zero;
  place.angle = counts ? control.angle : place.angle;
}

template <class T>
void ControlBuilder<T>::set_slider_control(JointLane<V>& joint, const Pair& pair,
                                           JointRows<T, model::JointKind::slider>& rows) const {
  const AxisControl<V>& control = joint.controls[0];
  const V zero = T::broadcast(0);
  const L3 axis = pair.a.rotation * joint.terms.axis1_a;
  const L3 apart = pair.b.position - pair.a.position;
  const V along = -dot(axis, apart + pair.b.rotation * joint.terms.anchor_b);
  AxisPlace place{zero, zero, along};
  set_limits(control, place);
  auto& row = rows.line_controls[0];
  const L3 moment = cross(slider_arm<T>(pair, apart), axis);
  rows_.set_line(axis, moment, moment, zero, T::broadcast(rows_.cfm()), pair, row.row);
  set_bounds(control, place, row);
  rows.control_on[0] = has_row(control, place);
}

}  // namespace pbmpi::solver
