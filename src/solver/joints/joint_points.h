/// Builds the rows that hold a point of one body at a point of another.
#pragma once

#include "solver/joints/joint_rows.h"
#include "solver/joints/joint_terms.h"

namespace pbmpi::solver {

/// S (arm x e_k): the change of angular velocity by an impulse along axis k at the end of the arm. The 0 in
/// arm x e_k is left out.
template <class V>
PBMPI_LANES Vec3L<V> turn_of(const Sym3L<V>& s, const Vec3L<V>& arm, int k) {
  const auto& [x, y, z] = arm;
  if (k == 0) return {s.xy * z - s.xz * y, s.yy * z - s.yz * y, s.yz * z - s.zz * y};
  if (k == 1) return {s.xz * x - s.xx * z, s.yz * x - s.xy * z, s.zz * x - s.xz * z};
  return {s.xx * y - s.xy * x, s.xy * y - s.yy * x, s.xz * y - s.yz * x};
}

/// (arm x e_k) . turn
template <class V>
PBMPI_LANES V turning(const Vec3L<V>& turn, const Vec3L<V>& arm, int k) {
  if (k == 0) return arm.z * turn.y - arm.y * turn.z;
  return k == 1 ? arm.x * turn.z - arm.z * turn.x : arm.y * turn.x - arm.x * turn.y;
}

/// The arm in the middle of a rotation by 2 `half_turn` [rad]: the mean of the arm before and after, by
/// Cayley's formula for the rotation, which moves its end by 2 half_turn x middle. No longer than the arm.
template <class T>
PBMPI_LANES Vec3L<typename T::V> middle_of_turn(const Vec3L<typename T::V>& arm,
                                                const Vec3L<typename T::V>& half_turn) {
  const typename T::V share = 1 / (1 + dot(half_turn, half_turn));
  return (arm + cross(half_turn, arm) + half_turn * dot(half_turn, arm)) * share;
}

/// Sets all except the impulse. `k` [1/s]: the rate at which the gap is to close. `ahead_s` [s]: the row acts
/// at the arms as the bodies' rotations will have turned them after this time; its gap is the current one.
/// With half a substep the row holds over the whole substep up to errors of third order in the bodies'
/// rotation (the midpoint rule); with 0, as in ODE, the ends leave their circles by half the square of that
/// rotation. scale_of(diagonal, before): the scale of a row, from its J M^-1 J^T and its last scale.
template <class T, class ScaleOf>
PBMPI_LANES void build_point(const JointTermsLane<typename T::V>& terms, const BodyLanes<T>& bodies,
                             int slot_a, int slot_b, typename T::Scalar k, typename T::Scalar ahead_s,
                             PointRows<typename T::V>& row, const ScaleOf& scale_of) {
  using V = typename T::V;
  const BodyLane<V>&a = bodies.bodies[slot_a], &b = bodies.bodies[slot_b];
  row.arm_a = a.rotation * terms.anchor_a;
  row.arm_b = b.rotation * terms.anchor_b;
  row.rhs = (b.position + row.arm_b - a.position - row.arm_a) * T::broadcast(k);
  if (ahead_s > 0) {
    row.arm_a = middle_of_turn<T>(row.arm_a, bodies.twists[slot_a].angular * T::broadcast(ahead_s));
    row.arm_b = middle_of_turn<T>(row.arm_b, bodies.twists[slot_b].angular * T::broadcast(ahead_s));
  }
  const V masses = a.inv_mass + b.inv_mass;
  const auto set_row = [&](int axis, V& scale) {
    row.turn_a[axis] = turn_of(a.inv_inertia, row.arm_a, axis);
    row.turn_b[axis] = turn_of(b.inv_inertia, row.arm_b, axis);
    scale = scale_of(
        masses + turning(row.turn_a[axis], row.arm_a, axis) + turning(row.turn_b[axis], row.arm_b, axis),
        scale);
  };
  set_row(0, row.scale.x);
  set_row(1, row.scale.y);
  set_row(2, row.scale.z);
}

}  // namespace pbmpi::solver
