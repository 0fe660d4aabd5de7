/// How a body turns under its own inertia alone.
#pragma once

#include "solver/layout/body_lanes.h"

namespace pbmpi::solver {

/// A body's inertia about its principal axes. The third is the one whose moment differs most from the others:
/// the axis of a symmetric body.
template <class V>
struct alignas(sizeof(V)) PrincipalInertia {
  V w, x, y, z;         ///< from the principal axes to the body's frame, a unit quaternion
  Vec3L<V> per_moment;  ///< 1 / moments [1 / (kg m^2)]
};

namespace turning_detail {

/// tan(x) / x for a square of x: the start of its series, with an error of 1e-9 at x = 0.25, which no body
/// but a rod at 700 rad/s reaches in half a substep. Beyond, a body turns by a wrong angle and keeps its
/// momentum.
template <class T>
PBMPI_LANES typename T::V tangent_ratio(const typename T::V& square) {
  constexpr double terms[] = {1.0 / 3, 2.0 / 15, 17.0 / 315, 62.0 / 2835, 1382.0 / 155925, 21844.0 / 6081075};
  typename T::V sum = T::broadcast(0);
  for (int i = 5; i >= 0; --i) sum = square * (T::broadcast(static_cast<typename T::Scalar>(terms[i])) + sum);
  return 1 + sum;
}

/// a b for unit quaternions.
template <class V>
struct alignas(sizeof(V)) QuatL {
  V w, x, y, z;
  PBMPI_LANES QuatL operator*(const QuatL& b) const {
    return {w * b.w - x * b.x - y * b.y - z * b.z, w * b.x + x * b.w + y * b.z - z * b.y,
            w * b.y - x * b.z + y * b.w + z * b.x, w * b.z + x * b.y - y * b.x + z * b.w};
  }
};

/// The body turns by `angle` [rad] about its principal axis, 1 or 2 (y or z), under a momentum that stays
/// where it is in the world. `turn`: how it has turned so far, times a factor, which grows.
template <class T, int axis>
PBMPI_LANES void turn_about(const typename T::V& angle, Vec3L<typename T::V>& momentum,
                            QuatL<typename T::V>& turn) {
  using V = typename T::V;
  const V half = angle * T::broadcast(static_cast<typename T::Scalar>(0.5));
  const V t = half * tangent_ratio<T>(half * half), square = t * t, share = 1 / (1 + square);
  const V cosine = (1 - square) * share, sine = 2 * t * share;
  const V zero = T::broadcast(0), one = T::broadcast(1);
  if constexpr (axis == 1) {
    momentum = {momentum.x * cosine - momentum.z * sine, momentum.y, momentum.z * cosine + momentum.x * sine};
    turn = turn * QuatL<V>{one, zero, t, zero};
  } else {
    momentum = {momentum.x * cosine + momentum.y * sine, momentum.y * cosine - momentum.x * sine, momentum.z};
    turn = turn * QuatL<V>{one, zero, zero, t};
  }
}

}  // namespace turning_detail

/// Moves a body for `h` [s]. Lanes that have a gyroscopic torque (`has_torque` 1, else 0) turn under their
/// own inertia alone, the others keep their angular velocity to the bit. Also sets the rotation. The momentum
/// stays the same up to rounding; the turning is that of a symmetric top, which is exact, between two half
/// steps of what is left of the body's inertia (symmetric splitting, as A. Dullweber, B. Leimkuhler and R.
/// McLachlan, "Symplectic splitting methods for rigid body molecular dynamics", J. Chem. Phys. 107, 1997):
/// reversible, with an energy that swings about its value and does not drift.
template <class T, bool last>
PBMPI_LANES void integrate_turning(const PrincipalInertia<typename T::V>& inertia, typename T::Scalar h,
                                   const typename T::V& has_torque, BodyLane<typename T::V>& body,
                                   Twist<typename T::V>& twist) {
  using V = typename T::V;
  using turning_detail::QuatL;
  const Mat3L<V> to_body = to_matrix(inertia.w, inertia.x, inertia.y, inertia.z);
  const Vec3L<V> spin = to_body.transposed_times(body.rotation.transposed_times(twist.angular));
  const Vec3L<V>& per = inertia.per_moment;
  Vec3L<V> momentum{spin.x / per.x, spin.y / per.y, spin.z / per.z};
  const V zero = T::broadcast(0), one = T::broadcast(1);
  QuatL<V> turn{one, zero, zero, zero};
  const V rest = (per.y - per.x) * T::broadcast(h / 2), odd = (per.z - per.x) * T::broadcast(h);
  turning_detail::turn_about<T, 1>(momentum.y * rest, momentum, turn);
  turning_detail::turn_about<T, 2>(momentum.z * odd, momentum, turn);
  turning_detail::turn_about<T, 1>(momentum.y * rest, momentum, turn);
  const Vec3L<V> half = momentum * (per.x * T::broadcast(h / 2));
  const Vec3L<V> about = half * turning_detail::tangent_ratio<T>(dot(half, half));
  turn = turn * QuatL<V>{one, about.x, about.y, about.z};
  // What the turn adds to the orientation is as small as the turn, so that a body at rest keeps its bits.
  const Vec3L<V> tangent = to_body * (Vec3L<V>{turn.x, turn.y, turn.z} * (1 / turn.w));
  const QuatL<V> added =
      QuatL<V>{body.qw, body.qx, body.qy, body.qz} * QuatL<V>{zero, tangent.x, tangent.y, tangent.z};
  const QuatL<V> q{body.qw + added.w, body.qx + added.x, body.qy + added.y, body.qz + added.z};
  const V inverse = 1 / T::sqrt(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
  const auto has = has_torque > T::broadcast(0);
  integrate<T, last>(body, twist, h);
  body.qw = has ? q.w * inverse : body.qw;
  body.qx = has ? q.x * inverse : body.qx;
  body.qy = has ? q.y * inverse : body.qy;
  body.qz = has ? q.z * inverse : body.qz;
  body.rotation = to_matrix(body.qw, body.qx, body.qy, body.qz);
  const Vec3L<V> turned{momentum.x * per.x, momentum.y * per.y, momentum.z * per.z};
  const Vec3L<V> velocity = body.rotation * (to_body * turned);
  twist.angular.x = has ? velocity.x : twist.angular.x;
  twist.angular.y = has ? velocity.y : twist.angular.y;
  twist.angular.z = has ? velocity.z : twist.angular.z;
}

}  // namespace pbmpi::solver
