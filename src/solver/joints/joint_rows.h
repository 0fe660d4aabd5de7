/// The rows of one joint of up to `num_lanes` articulations, with a type for each kind of joint, so that the
/// sweep knows at compile time what it solves.
///
/// Which rows each kind has (model/joint_traits.h), with signs and right-hand sides as in ODE 0.16's joints
/// (ode/src/joints/*.cpp):
///   ball       3 point                      hinge   3 point + 2 axis + limit/motor
///   universal  3 point + 1 axis + 2 l/m     fixed   3 point + 3 axis
///   hinge2     3 line (along axis 1 with the suspension's ERP and CFM, and across) + 1 axis + 2 l/m
///   slider     2 line + 3 axis + limit/motor along the line
#pragma once

#include <array>
#include <cstddef>
#include <type_traits>

#include "model/joint_traits.h"
#include "solver/layout/body_lanes.h"
#include "solver/layout/row_law.h"

namespace pbmpi::solver {

/// How many rows of each type a joint has.
struct RowCounts {
  int points = 0;  ///< blocks of three rows
  int lines = 0, axes = 0;
  int axis_controls = 0, line_controls = 0;  ///< rows of limits and motors
};

constexpr RowCounts row_counts(model::JointKind kind) {
  const model::JointTraits& traits = model::traits_of(kind);
  const bool as_points = traits.place == model::HeldPlace::anchor || traits.place == model::HeldPlace::offset;
  return {.points = as_points ? 1 : 0,
          .lines = as_points ? 0 : traits.place_rows(),
          .axes = traits.turn_rows(),
          .axis_controls = traits.slides ? 0 : traits.num_axes,
          .line_controls = traits.slides ? traits.num_axes : 0};
}

/// A row of a limit or a motor.
template <class Row, class V>
struct alignas(sizeof(V)) Bounded {
  Row row;
  V low, high;    ///< bounds of its impulse [N s or N m s]
  V relaxed_rhs;  ///< in sweeps that correct no position error: the motor's target velocity
  V push;         ///< impulse of a motor at its limit, once a substep; acts on a against the axis
  V at_limit;     ///< 1: a limit, which is a spring, holds; 0: a motor, which is rigid, drives
};

template <class T, model::JointKind kind>
struct alignas(sizeof(typename T::V)) JointRows {
  using V = typename T::V;
  static constexpr RowCounts counts = row_counts(kind);

  int slot_a = 0, slot_b = 0;
  bool control_on[2] = {false, false};  ///< does this axis have a row now, in any lane?
  bool sprung = false;                  ///< is the first line a suspension spring?
  V inv_mass_a, inv_mass_b;
  std::array<PointRows<V>, counts.points> points;
  std::array<LineRow<V>, counts.lines> lines;
  std::array<AxisRow<V>, counts.axes> axes;
  std::array<Bounded<AxisRow<V>, V>, counts.axis_controls> axis_controls;
  std::array<Bounded<LineRow<V>, V>, counts.line_controls> line_controls;
};

/// Calls visit(row) for each single row: lines, axes, and limits and motors that are on.
template <class Rows, class Visit>
PBMPI_LANES void for_each_single_row(Rows& rows, Visit visit) {
  for (auto& row : rows.lines) visit(row);
  for (auto& row : rows.axes) visit(row);
  for (std::size_t i = 0; i < rows.axis_controls.size(); ++i) {
    if (rows.control_on[i]) visit(rows.axis_controls[i].row);
  }
  for (std::size_t i = 0; i < rows.line_controls.size(); ++i) {
    if (rows.control_on[i]) visit(rows.line_controls[i].row);
  }
}

/// The laws of a sweep over joints: one for rows that hold a place, one for rows that hold an orientation and
/// for limits.
template <class Scalar>
struct JointLaws {
  RowLaw<Scalar> places, turns;
  Scalar exact_bias = 1;  ///< RowLaw::bias of rows solved exactly, which have no relief

  static JointLaws relaxing() { return {RowLaw<Scalar>::relaxing(), RowLaw<Scalar>::relaxing(), 0}; }
};

/// ERP of the rows of JointLaws, in a substep.
template <class Scalar>
struct JointErp {
  Scalar places = 0, turns = 0;
};

/// Sweeps over the rows of a joint. The rows' scale already contains the SOR factor.
template <class T>
class JointSolver {
 public:
  using V = typename T::V;
  using Scalar = typename T::Scalar;

  /// `cfm` [s/kg]: the joints' CFM divided by the step; `laws`: those of this sweep.
  JointSolver(Scalar cfm, const JointLaws<Scalar>& laws) : cfm_(cfm), laws_(laws) {}

  /// The share of the rows' right-hand sides that an exact solve uses.
  Scalar exact_bias() const { return laws_.exact_bias; }

  /// Solves rows in ODE's order, places before angles before limits and motors; `places_last`: in reverse.
  template <bool places_last, model::JointKind kind>
  PBMPI_LANES void solve(JointRows<T, kind>& rows, BodyLanes<T>& bodies) const {
    Twist<V> a = bodies.twists[rows.slot_a], b = bodies.twists[rows.slot_b];
    if constexpr (places_last) {
      solve_controls(rows, a, b);
      solve_axes(rows, a, b);
      solve_lines(rows, a, b);
      solve_points(rows, a, b);
    } else {
      solve_points(rows, a, b);
      solve_lines(rows, a, b);
      solve_axes(rows, a, b);
      solve_controls(rows, a, b);
    }
    bodies.twists[rows.slot_a] = a;
    bodies.twists[rows.slot_b] = b;
  }

  /// Solves limits and motors only.
  template <model::JointKind kind>
  PBMPI_LANES void solve_controls(JointRows<T, kind>& rows, BodyLanes<T>& bodies) const {
    solve_controls(rows, bodies.twists[rows.slot_a], bodies.twists[rows.slot_b]);
  }

  /// A motor at its limit acts as an external torque (ODE: dxJointLimitMotor::addLimot).
  template <model::JointKind kind>
  PBMPI_LANES static void push_motors(const JointRows<T, kind>& rows, BodyLanes<T>& bodies) {
    Twist<V>&a = bodies.twists[rows.slot_a], &b = bodies.twists[rows.slot_b];
    for (std::size_t i = 0; i < rows.axis_controls.size(); ++i) {
      if (!rows.control_on[i]) continue;
      const AxisRow<V>& row = rows.axis_controls[i].row;
      const V& push = rows.axis_controls[i].push;
      a.angular = a.angular - row.turn_a * push;
      b.angular = b.angular + row.turn_b * push;
    }
    for (std::size_t i = 0; i < rows.line_controls.size(); ++i) {
      if (!rows.control_on[i]) continue;
      const LineRow<V>& row = rows.line_controls[i].row;
      const V& push = rows.line_controls[i].push;
      a.linear = a.linear - row.direction * (rows.inv_mass_a * push);
      a.angular = a.angular - row.turn_a * push;
      b.linear = b.linear + row.direction * (rows.inv_mass_b * push);
      b.angular = b.angular - row.turn_b * push;
    }
  }

  /// Applies the impulses with which the rows start to the bodies.
  template <model::JointKind kind>
  PBMPI_LANES static void push_carried(const JointRows<T, kind>& rows, BodyLanes<T>& bodies) {
    Twist<V> a = bodies.twists[rows.slot_a], b = bodies.twists[rows.slot_b];
    for (const PointRows<V>& row : rows.points) {
      const Vec3L<V>& p = row.impulse;
      a.linear = a.linear + p * rows.inv_mass_a;
      b.linear = b.linear - p * rows.inv_mass_b;
      a.angular = a.angular + row.turn_a[0] * p.x + row.turn_a[1] * p.y + row.turn_a[2] * p.z;
      b.angular = b.angular - row.turn_b[0] * p.x - row.turn_b[1] * p.y - row.turn_b[2] * p.z;
    }
    for_each_single_row(rows, [&](const auto& row) {
      if constexpr (std::is_same_v<std::remove_cvref_t<decltype(row)>, AxisRow<V>>) {
        a.angular = a.angular + row.turn_a * row.impulse;
        b.angular = b.angular - row.turn_b * row.impulse;
      } else {
        apply(row, row.impulse, rows.inv_mass_a, a);
        apply_to_b(row, row.impulse, rows.inv_mass_b, b);
      }
    });
    bodies.twists[rows.slot_a] = a;
    bodies.twists[rows.slot_b] = b;
  }

 private:
  template <model::JointKind kind>
  PBMPI_LANES void solve_points(JointRows<T, kind>& rows, Twist<V>& a, Twist<V>& b) const {
    for (PointRows<V>& row : rows.points) solve_point(row, rows.inv_mass_a, rows.inv_mass_b, a, b);
  }
  template <model::JointKind kind>
  PBMPI_LANES void solve_lines(JointRows<T, kind>& rows, Twist<V>& a, Twist<V>& b) const {
    for (std::size_t i = 0; i < rows.lines.size(); ++i) {
      LineRow<V>& row = rows.lines[i];
      // A suspension has its own spring in all sweeps.
      const RowLaw<Scalar>& law = rows.sprung && i == 0 ? RowLaw<Scalar>{} : laws_.places;
      push(row, step_of(row, row.rhs * law.bias, law, a, b), rows.inv_mass_a, rows.inv_mass_b, a, b);
    }
  }
  template <model::JointKind kind>
  PBMPI_LANES void solve_axes(JointRows<T, kind>& rows, Twist<V>& a, Twist<V>& b) const {
    for (AxisRow<V>& row : rows.axes)
      push(row, step_of(row, row.rhs * laws_.turns.bias, laws_.turns, a, b), a, b);
  }
  template <model::JointKind kind>
  PBMPI_LANES void solve_controls(JointRows<T, kind>& rows, Twist<V>& a, Twist<V>& b) const {
    for (std::size_t i = 0; i < rows.axis_controls.size(); ++i) {
      if (!rows.control_on[i]) continue;
      auto& control = rows.axis_controls[i];
      push(control.row, controlled(control, a, b), a, b);
    }
    for (std::size_t i = 0; i < rows.line_controls.size(); ++i) {
      if (!rows.control_on[i]) continue;
      auto& control = rows.line_controls[i];
      push(control.row, controlled(control, a, b), rows.inv_mass_a, rows.inv_mass_b, a, b);
    }
  }
  PBMPI_LANES void solve_point(PointRows<V>& row, const V& inv_mass_a, const V& inv_mass_b, Twist<V>& a,
                               Twist<V>& b) const {
    const RowLaw<Scalar>& law = laws_.places;
    const Vec3L<V>&ra = row.arm_a, &rb = row.arm_b;
    const auto apply = [&](V speed, V rhs, V scale, V& impulse, V& linear_a, V& linear_b, int k) {
      const V change =
          (rhs * law.bias - speed - cfm_ * impulse) * (scale * law.mass_share) - law.relief * impulse;
      impulse += change;
      linear_a += inv_mass_a * change;
      linear_b -= inv_mass_b * change;
      a.angular = a.angular + row.turn_a[k] * change;
      b.angular = b.angular - row.turn_b[k] * change;
    };
    const auto speed_of = [](V linear_a, V w1_a, V r2_a, V w2_a, V r1_a, V linear_b, V w1_b, V r2_b, V w2_b,
                             V r1_b) {
      return linear_a + w1_a * r2_a - w2_a * r1_a - linear_b - w1_b * r2_b + w2_b * r1_b;
    };
    apply(speed_of(a.linear.x, a.angular.y, ra.z, a.angular.z, ra.y, b.linear.x, b.angular.y, rb.z,
                   b.angular.z, rb.y),
          row.rhs.x, row.scale.x, row.impulse.x, a.linear.x, b.linear.x, 0);
    apply(speed_of(a.linear.y, a.angular.z, ra.x, a.angular.x, ra.z, b.linear.y, b.angular.z, rb.x,
                   b.angular.x, rb.z),
          row.rhs.y, row.scale.y, row.impulse.y, a.linear.y, b.linear.y, 1);
    apply(speed_of(a.linear.z, a.angular.x, ra.y, a.angular.y, ra.x, b.linear.z, b.angular.x, rb.y,
                   b.angular.y, rb.x),
          row.rhs.z, row.scale.z, row.impulse.z, a.linear.z, b.linear.z, 2);
  }

  /// A motor keeps its target velocity in all sweeps.
  template <class Row>
  PBMPI_LANES V rhs_of(const Bounded<Row, V>& control) const {
    return laws_.turns.bias > 0 ? control.row.rhs : control.relaxed_rhs;
  }
  /// The impulse of a row after a Gauss-Seidel step on it, before bounds.
  PBMPI_LANES V step_of(const AxisRow<V>& row, const V& rhs, const RowLaw<Scalar>& law, const Twist<V>& a,
                        const Twist<V>& b) const {
    return row.impulse +
           ((rhs - dot(row.axis, a.angular - b.angular) - cfm_ * row.impulse) * (row.scale * law.mass_share) -
            law.relief * row.impulse);
  }
  PBMPI_LANES static V step_of(const LineRow<V>& row, const V& rhs, const RowLaw<Scalar>& law,
                               const Twist<V>& a, const Twist<V>& b) {
    return row.impulse +
           ((rhs - relative_speed(row, a, b) - row.cfm * row.impulse) * (row.scale * law.mass_share) -
            law.relief * row.impulse);
  }
  /// The impulse of a limit or motor after a Gauss-Seidel step on it. A limit gives under the load that it
  /// carries, except the push of its own motor: together the two do nothing to the bodies.
  template <class Row>
  PBMPI_LANES V controlled(const Bounded<Row, V>& control, const Twist<V>& a, const Twist<V>& b) const {
    const V& impulse = control.row.impulse;
    const V mass_share = 1 - control.at_limit * T::broadcast(1 - laws_.turns.mass_share);
    const V relief = control.at_limit * T::broadcast(laws_.turns.relief);
    const V rigid = step_of(control.row, rhs_of(control), RowLaw<Scalar>{}, a, b) - impulse;
    return clamped(control, impulse + (rigid * mass_share - relief * (impulse - control.push)));
  }
  template <class Row>
  PBMPI_LANES static V clamped(const Bounded<Row, V>& control, const V& impulse) {
    return T::min(T::max(impulse, control.low), control.high);
  }
  /// Brings a row to this impulse.
  PBMPI_LANES static void push(AxisRow<V>& row, const V& impulse, Twist<V>& a, Twist<V>& b) {
    const V change = impulse - row.impulse;
    row.impulse = impulse;
    a.angular = a.angular + row.turn_a * change;
    b.angular = b.angular - row.turn_b * change;
  }
  PBMPI_LANES static void push(LineRow<V>& row, const V& impulse, const V& inv_mass_a, const V& inv_mass_b,
                               Twist<V>& a, Twist<V>& b) {
    const V change = impulse - row.impulse;
    row.impulse = impulse;
    apply(row, change, inv_mass_a, a);
    apply_to_b(row, change, inv_mass_b, b);
  }

  Scalar cfm_;
  JointLaws<Scalar> laws_;
};

}  // namespace pbmpi::solver
