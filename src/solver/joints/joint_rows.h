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

#include "model/joint_traits.h"
#include "solver/lanes/symmetric_factor.h"
#include "solver/layout/body_lanes.h"

namespace pbmpi::solver {

/// How many rows of each type a joint has.
struct RowCounts {
  int points = 0;  ///< blocks of three rows
  int lines = 0, axes = 0;
  int axis_controls = 0, line_controls = 0;  ///< rows of limits and motors

  constexpr int places() const { return 3 * points + lines; }
  /// Rows without limits and motors.
  constexpr int held() const { return places() + axes; }
  constexpr int all() const { return held() + axis_controls + line_controls; }
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

/// What an axis does in a substep: it is at a limit (with its error), driven, or free.
template <class V>
struct alignas(sizeof(V)) ControlState {
  V rhs, low, high;  ///< of the row
  V relaxed_rhs;     ///< of the row in sweeps that correct no position error
  V push;            ///< of a motor at its limit: see Bounded
  V at_limit;        ///< 1: a limit holds; 0: a motor drives
};

/// What turns, or moves, with the coordinate of an axis alone: model::Joint::armature.
template <class V>
struct alignas(sizeof(V)) Rotor {
  V inertia;  ///< [kg m^2] or [kg]
  V start;    ///< [rad/s] or [m/s] speed of the coordinate when the substep began
  V impulse;  ///< by which it changes the bodies' velocities: inertia (start - speed)
};

/// A row of a limit or a motor.
template <class Row, class V>
struct alignas(sizeof(V)) Bounded {
  Row row;
  V low, high;    ///< bounds of its impulse [N s or N m s]
  V relaxed_rhs;  ///< in sweeps that correct no position error: the motor's target velocity
  V push;         ///< impulse of a motor at its limit, once a substep; acts on a against the axis
  V at_limit;     ///< 1: a limit, which is a spring, holds; 0: a motor, which is rigid, drives
  Rotor<V> rotor;

  PBMPI_LANES void set(const ControlState<V>& state) {
    row.rhs = state.rhs;
    low = state.low;
    high = state.high;
    relaxed_rhs = state.relaxed_rhs;
    push = state.push;
    at_limit = state.at_limit;
  }
};

template <class T, model::JointKind kind>
struct alignas(sizeof(typename T::V)) JointRows {
  using V = typename T::V;
  static constexpr RowCounts counts = row_counts(kind);

  int slot_a = 0, slot_b = 0;
  bool control_on[2] = {false, false};  ///< does this axis have a row now, in any lane?
  bool sprung = false;                  ///< is the first line a suspension spring?
  bool has_rotors = false;              ///< in any lane
  V inv_mass_a, inv_mass_b;
  V reversible;  ///< the share of the reversible scheme: see JointBuilder
  std::array<PointRows<V>, counts.points> points;
  std::array<LineRow<V>, counts.lines> lines;
  std::array<AxisRow<V>, counts.axes> axes;
  std::array<Bounded<AxisRow<V>, V>, counts.axis_controls> axis_controls;
  std::array<Bounded<LineRow<V>, V>, counts.line_controls> line_controls;
  V holds;  ///< 1, or 0 in the lanes whose joint is broken
  /// Of J M^-1 J^T + cfm over the rows in the order points, lines, axes, limits and motors; these only if any
  /// acts. Set when a sweep first needs it.
  SymmetricFactor<T, counts.all()> block;
  bool has_block = false;

  /// Does a limit, a motor or a rotor act, in any lane?
  bool acts() const { return control_on[0] || control_on[1] || has_rotors; }
};

/// Calls visit(control, axis) for each row of a limit or motor, on or not.
template <class Rows, class Visit>
PBMPI_LANES void for_each_control(Rows& rows, Visit visit) {
  for (std::size_t i = 0; i < rows.axis_controls.size(); ++i) visit(rows.axis_controls[i], i);
  for (std::size_t i = 0; i < rows.line_controls.size(); ++i) visit(rows.line_controls[i], i);
}

/// Calls visit(row) for each single row: lines, axes, and limits and motors that are on.
template <class Rows, class Visit>
PBMPI_LANES void for_each_single_row(Rows& rows, Visit visit) {
  for (auto& row : rows.lines) visit(row);
  for (auto& row : rows.axes) visit(row);
  for_each_control(rows, [&](auto& control, std::size_t axis) {
    if (rows.control_on[axis]) visit(control.row);
  });
}

}  // namespace pbmpi::solver
