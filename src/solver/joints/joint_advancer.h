/// Advances the rows of a joint from one substep to the next.
#pragma once

#include "solver/joints/joint_controls.h"
#include "solver/joints/joint_points.h"

namespace pbmpi::solver {

/// Holds what is uniform in the substeps after a step's first. The arms of point rows, which decide a joint's
/// gap, and all that follows from them are built anew. Axes and lines stay fixed through the step, like
/// contacts, with their errors advanced by the velocities that the rows have left: the next step sees in the
/// poses what that misses, which is of second order in the bodies' rotation in a step.
template <class T>
class JointAdvancer {
 public:
  using V = typename T::V;
  using Scalar = typename T::Scalar;

  /// As in JointBuilder; `carry`: the share of a row's impulse with which its next impulse starts; `ahead_s`:
  /// for the next substep.
  JointAdvancer(Scalar h, const JointErp<Scalar>& erp, Scalar cfm, Scalar sor_factor, Scalar carry,
                Scalar ahead_s)
      : controls_(h, erp.turns),
        erp_(erp),
        cfm_(cfm / h),
        inverse_factor_(1 / sor_factor),
        carry_(carry),
        ahead_s_(ahead_s) {}

  /// Before the bodies move with their current twists.
  template <model::JointKind kind>
  PBMPI_LANES void advance(JointLane<V>& joint, const BodyLanes<T>& bodies, JointRows<T, kind>& rows) const;
  /// After the bodies have moved.
  template <model::JointKind kind>
  PBMPI_LANES void rebuild(const JointLane<V>& joint, const BodyLanes<T>& bodies,
                           JointRows<T, kind>& rows) const;
  /// Sets the limits and motors of the next substep, and the share of the impulses that it takes over, which
  /// have not acted on the twists yet.
  template <model::JointKind kind>
  PBMPI_LANES void restart(const JointLane<V>& joint, JointRows<T, kind>& rows) const;

 private:
  V carried(const V& impulse) const { return carry_ > 0 ? impulse * T::broadcast(carry_) : T::broadcast(0); }
  /// One Newton step from the last scale towards factor / diagonal. This is accurate enough: the scale
  /// decides how fast a row converges, not to what. The result is not too large for a diagonal of up to four
  /// times the last one.
  V scale_of(const V& diagonal, const V& before) const {
    const V least = T::broadcast(static_cast<Scalar>(0.25));
    return before * T::max(2 - (diagonal + cfm_) * before * inverse_factor_, least);
  }
  /// Sets bounds and right-hand side of an axis's row. Returns whether any lane has a row.
  template <class Row>
  PBMPI_LANES bool control(const AxisControl<V>& control, Bounded<Row, V>& row) const;

  ControlRules<T> controls_;
  JointErp<Scalar> erp_;
  Scalar cfm_, inverse_factor_, carry_, ahead_s_;
};

template <class T>
template <model::JointKind kind>
PBMPI_LANES void JointAdvancer<T>::advance(JointLane<V>& joint, const BodyLanes<T>& bodies,
                                           JointRows<T, kind>& rows) const {
  const Twist<V>&a = bodies.twists[rows.slot_a], &b = bodies.twists[rows.slot_b];
  const Vec3L<V> turning = a.angular - b.angular;
  const V turn_erp = T::broadcast(erp_.turns), place_erp = T::broadcast(erp_.places);
  for (AxisRow<V>& row : rows.axes) row.rhs = row.rhs - turn_erp * dot(row.axis, turning);
  for (std::size_t i = 0; i < rows.lines.size(); ++i) {
    LineRow<V>& row = rows.lines[i];
    const bool springs = kind == model::JointKind::hinge2 && joint.sprung && i == 0;
    // A spring's ERP is h k / (h k + damping), its CFM (here over h) 1 / (h (h k + damping)).
    const V share = springs ? joint.terms.stiffness * row.cfm * (controls_.h() * controls_.h()) : place_erp;
    row.rhs = row.rhs - share * relative_speed(row, a, b);
  }
  for (std::size_t i = 0; i < rows.axis_controls.size(); ++i) {
    AxisControl<V>& control = joint.controls[i];
    if (control.is_placed())
      control.place = control.place + controls_.h() * dot(rows.axis_controls[i].row.axis, turning);
  }
  for (std::size_t i = 0; i < rows.line_controls.size(); ++i) {
    AxisControl<V>& control = joint.controls[i];
    control.place = control.place + controls_.h() * relative_speed(rows.line_controls[i].row, a, b);
  }
}

template <class T>
template <model::JointKind kind>
PBMPI_LANES void JointAdvancer<T>::rebuild(const JointLane<V>& joint, const BodyLanes<T>& bodies,
                                           JointRows<T, kind>& rows) const {
  for (PointRows<V>& row : rows.points)
    build_point<T>(joint.terms, bodies, rows.slot_a, rows.slot_b, erp_.places / controls_.h(), ahead_s_, row,
                   [&](const V& diagonal, const V& before) { return scale_of(diagonal, before); });
}

template <class T>
template <model::JointKind kind>
PBMPI_LANES void JointAdvancer<T>::restart(const JointLane<V>& joint, JointRows<T, kind>& rows) const {
  if (carry_ != 1) {
    for (PointRows<V>& row : rows.points)
      row.impulse = {carried(row.impulse.x), carried(row.impulse.y), carried(row.impulse.z)};
    for (LineRow<V>& row : rows.lines) row.impulse = carried(row.impulse);
    for (AxisRow<V>& row : rows.axes) row.impulse = carried(row.impulse);
  }
  for (std::size_t i = 0; i < rows.axis_controls.size(); ++i) {
    if (joint.controls[i].any()) rows.control_on[i] = control(joint.controls[i], rows.axis_controls[i]);
  }
  for (std::size_t i = 0; i < rows.line_controls.size(); ++i)
    rows.control_on[i] = control(joint.controls[i], rows.line_controls[i]);
}

template <class T>
template <class Row>
PBMPI_LANES bool JointAdvancer<T>::control(const AxisControl<V>& control, Bounded<Row, V>& row) const {
  const V zero = T::broadcast(0), one = T::broadcast(1);
  V at_low = zero, at_high = zero;
  if (control.has_limit) {
    at_low = control.place <= control.low ? one : zero;
    at_high = at_low > zero ? zero : (control.place >= control.high ? one : zero);
  }
  if (!control.has_motor && !T::any(at_low + at_high)) {
    row.row.impulse = zero;  // nothing for a later substep to carry
    return false;
  }
  const ControlState<V> state = controls_.decide(control, at_low, at_high, control.place);
  row.row.rhs = state.rhs;
  set_bounds(state, row);
  row.row.impulse = T::min(T::max(carried(row.row.impulse), state.low), state.high);
  return true;
}

}  // namespace pbmpi::solver
