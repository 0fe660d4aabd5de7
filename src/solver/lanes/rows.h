/// Rows of the constraint system, in typed blocks. At velocity level, for rows with Jacobian J:
///   change = (J M^-1 J^T + cfm)^-1 (rhs - J v - cfm p),  p += change (clamped),  v += M^-1 J^T change,
/// with impulses p = h lambda. Its fixed point is that of ODE's (J M^-1 J^T + cfm/h) lambda = c/h - J (v/h +
/// M^-1 f) (ODE manual, "Joint error and the ERP"; ode/src/quickstep.cpp).
#pragma once

#include "solver/lanes/lanes.h"

namespace pbmpi::solver {

/// Velocity of a body: linear [m/s] and angular [rad/s], world frame.
template <class V>
struct alignas(sizeof(V)) Twist {
  Vec3L<V> linear, angular;
};

/// Three rows that hold a point of a at a point of b, along the world's axes.
template <class V>
struct alignas(sizeof(V)) PointRows {
  Vec3L<V> arm_a, arm_b;          ///< from the centres to the points
  Vec3L<V> turn_a[3], turn_b[3];  ///< I^-1 (arm x e_k)
  Vec3L<V> rhs, ahead, impulse;   ///< ahead: see JointBuilder
};

/// A row on the relative angular velocity along an axis.
template <class V>
struct alignas(sizeof(V)) AxisRow {
  Vec3L<V> axis, turn_a, turn_b;  ///< turn: I^-1 axis
  V rhs, ahead, impulse;          ///< ahead: see JointBuilder
};

/// A row along a direction through a point: contacts, suspension, slider. It has its own CFM.
template <class V>
struct alignas(sizeof(V)) LineRow {
  Vec3L<V> direction, moment_a, moment_b;  ///< moments: the angular parts of J; b's includes its sign
  Vec3L<V> turn_a, turn_b;                 ///< I^-1 moment
  V rhs, ahead, cfm, impulse;              ///< ahead: see JointBuilder
};

template <class V>
PBMPI_LANES V relative_speed(const LineRow<V>& row, const Twist<V>& a, const Twist<V>& b) {
  return dot(row.direction, a.linear - b.linear) + dot(row.moment_a, a.angular) +
         dot(row.moment_b, b.angular);
}

template <class V>
PBMPI_LANES V relative_speed(const LineRow<V>& row, const Twist<V>& a) {
  return dot(row.direction, a.linear) + dot(row.moment_a, a.angular);
}

template <class V>
PBMPI_LANES void apply(const LineRow<V>& row, const V& change, const V& inv_mass, Twist<V>& a) {
  a.linear = a.linear + row.direction * (inv_mass * change);
  a.angular = a.angular + row.turn_a * change;
}

template <class V>
PBMPI_LANES void apply_to_b(const LineRow<V>& row, const V& change, const V& inv_mass, Twist<V>& b) {
  b.linear = b.linear - row.direction * (inv_mass * change);
  b.angular = b.angular + row.turn_b * change;
}

}  // namespace pbmpi::solver
