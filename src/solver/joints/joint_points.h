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

/// The arm in the middle of a rotation by 2 `half_turn` [rad]: the mean of the arm before and after, by
/// Cayley's formula for the rotation, which moves its end by 2 half_turn x middle. No longer than the arm.
template <class T>
PBMPI_LANES Vec3L<typename T::V> middle_of_turn(const Vec3L<typename T::V>& arm,
                                                const Vec3L<typename T::V>& half_turn) {
  const typename T::V share = 1 / (1 + dot(half_turn, half_turn));
  return (arm + cross(half_turn, arm) + half_turn * dot(half_turn, arm)) * share;
}

/// A velocity [m/s] that is no faster than `fastest`.
template <class T>
PBMPI_LANES Vec3L<typename T::V> slowed(const Vec3L<typename T::V>& velocity, typename T::Scalar fastest) {
  using V = typename T::V;
  const V square = dot(velocity, velocity), one = T::broadcast(1), zero = T::broadcast(0);
  const auto is_fast = square > T::broadcast(fastest * fastest);
  if (!T::any(is_fast ? one : zero)) return velocity;
  return velocity * (is_fast ? T::broadcast(fastest) / T::sqrt(square) : one);
}

/// [m/s] What the end of an arm gains in half a substep on the speed that it has at its start, as its body
/// turns on at the same angular velocity.
template <class T>
PBMPI_LANES Vec3L<typename T::V> gain_of_arm(const Vec3L<typename T::V>& arm,
                                             const Vec3L<typename T::V>& angular, typename T::Scalar half_s) {
  return cross(angular, middle_of_turn<T>(arm, angular * T::broadcast(half_s)) - arm);
}

/// [m] From the centre of a to that of b. `exact`: above 0 in the lanes whose joints are solved exactly.
/// There the rounding of one number to a coordinate would shake bodies that are far from the origin, and
/// nothing takes the energy.
template <class T>
PBMPI_LANES Vec3L<typename T::V> centres_apart(const BodyLane<typename T::V>& a,
                                               const BodyLane<typename T::V>& b, const typename T::V& exact) {
  const auto apart = b.position - a.position;
  if (sizeof(typename T::Scalar) == sizeof(double) || !T::any(exact)) return apart;
  return chosen(exact > T::broadcast(0), apart + (b.position_low - a.position_low), apart);
}

/// [m] From the end of an arm of a to the end of an arm of b; `exact`: likewise.
template <class T>
PBMPI_LANES Vec3L<typename T::V> ends_apart(const BodyLane<typename T::V>& a,
                                            const Vec3L<typename T::V>& arm_a,
                                            const BodyLane<typename T::V>& b,
                                            const Vec3L<typename T::V>& arm_b, const typename T::V& exact) {
  const auto apart = b.position + arm_b - a.position - arm_a;
  if (sizeof(typename T::Scalar) == sizeof(double) || !T::any(exact)) return apart;
  return chosen(exact > T::broadcast(0), centres_apart<T>(a, b, exact) + (arm_b - arm_a), apart);
}

/// Sets all except the impulse, with nothing ahead; `ahead_s` and `reversible`: see JointBuilder. `k` [1/s]:
/// the rate at which the gap is to close, no faster than `fastest` [m/s].
template <class T>
PBMPI_LANES void build_point(const JointTermsLane<typename T::V>& terms, const BodyLanes<T>& bodies,
                             int slot_a, int slot_b, typename T::Scalar k, typename T::Scalar ahead_s,
                             const typename T::V& reversible, typename T::Scalar fastest,
                             PointRows<typename T::V>& row) {
  using V = typename T::V;
  const BodyLane<V>&a = bodies.bodies[slot_a], &b = bodies.bodies[slot_b];
  row.arm_a = a.rotation * terms.anchor_a;
  row.arm_b = b.rotation * terms.anchor_b;
  row.ahead = {T::broadcast(0), T::broadcast(0), T::broadcast(0)};
  row.rhs = slowed<T>(ends_apart<T>(a, row.arm_a, b, row.arm_b, reversible) * T::broadcast(k), fastest);
  if (ahead_s > 0) {
    const V half = T::broadcast(ahead_s), rest = 1 - reversible;
    const auto turned = [&](const Vec3L<V>& arm, int slot) {
      return arm + (middle_of_turn<T>(arm, bodies.twists[slot].angular * half) - arm) * rest;
    };
    row.arm_a = turned(row.arm_a, slot_a);
    row.arm_b = turned(row.arm_b, slot_b);
  }
  for (int axis = 0; axis < 3; ++axis) {
    row.turn_a[axis] = turn_of(a.inv_inertia, row.arm_a, axis);
    row.turn_b[axis] = turn_of(b.inv_inertia, row.arm_b, axis);
  }
}

}  // namespace pbmpi::solver
