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
  PBMPI_LANES QuatL operator*(const V& s) const { return {w * s, x * s, y * s, z * s}; }
  PBMPI_LANES V square() const { return w * w + x * x + y * y + z * z; }
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

/// How a body has turned: its orientation, times a factor, and its angular velocity in its own frame.
template <class V>
struct alignas(sizeof(V)) FreeTurn {
  turning_detail::QuatL<V> orientation;
  Vec3L<V> spin;
};

/// The body turns for `h` [s] under its own inertia alone. `rotation`: that of `orientation`.
///
/// The momentum stays the same up to rounding; the turning is that of a symmetric top, which is exact,
/// between two half steps of what is left of the body's inertia (symmetric splitting, as A. Dullweber, B.
/// Leimkuhler and R. McLachlan, "Symplectic splitting methods for rigid body molecular dynamics", J. Chem.
/// Phys. 107, 1997): reversible, with an energy that swings about its value and does not drift.
template <class T>
PBMPI_LANES FreeTurn<typename T::V> turn_freely(const PrincipalInertia<typename T::V>& inertia,
                                                typename T::Scalar h,
                                                const turning_detail::QuatL<typename T::V>& orientation,
                                                const Mat3L<typename T::V>& rotation,
                                                const Vec3L<typename T::V>& angular) {
  using V = typename T::V;
  using turning_detail::QuatL;
  const Mat3L<V> to_body = to_matrix(inertia.w, inertia.x, inertia.y, inertia.z);
  const Vec3L<V> spin = to_body.transposed_times(rotation.transposed_times(angular));
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
  const QuatL<V> added = orientation * QuatL<V>{zero, tangent.x, tangent.y, tangent.z};
  return {
      {orientation.w + added.w, orientation.x + added.x, orientation.y + added.y, orientation.z + added.z},
      to_body * Vec3L<V>{momentum.x * per.x, momentum.y * per.y, momentum.z * per.z}};
}

namespace turning_detail {

/// q of unit length.
template <class T>
PBMPI_LANES QuatL<typename T::V> unit(const QuatL<typename T::V>& q) {
  return q * (1 / T::sqrt(q.square()));
}
/// Likewise, in double precision: a root in single precision, and a step of Newton's method for its inverse.
template <class T>
PBMPI_LANES QuatL<typename T::Wide::V> wide_unit(const QuatL<typename T::Wide::V>& q) {
  const typename T::Wide::V square = q.square(), near = T::widen(1 / T::sqrt(T::narrow(square)));
  return q * (near * (1.5 - 0.5 * square * near * near));
}

/// turn_freely() in double precision, to unit length. The angular velocity is that in the world's frame.
template <class T>
PBMPI_LANES FreeTurn<typename T::V> turn_widely(const PrincipalInertia<typename T::V>& inertia,
                                                typename T::Scalar h, const QuatL<typename T::V>& orientation,
                                                const Vec3L<typename T::V>& angular) {
  using Wide = typename T::Wide;
  using W = typename Wide::V;
  const auto wide = [](const auto& v) { return Vec3L<W>{T::widen(v.x), T::widen(v.y), T::widen(v.z)}; };
  const auto unit_of = [](const auto& q) {
    return wide_unit<T>({T::widen(q.w), T::widen(q.x), T::widen(q.y), T::widen(q.z)});
  };
  const QuatL<W> from = unit_of(orientation), axes = unit_of(inertia);
  const FreeTurn<W> turn = turn_freely<Wide>({axes.w, axes.x, axes.y, axes.z, wide(inertia.per_moment)}, h,
                                             from, to_matrix(from.w, from.x, from.y, from.z), wide(angular));
  const QuatL<W> q = wide_unit<T>(turn.orientation);
  const Vec3L<W> turned = to_matrix(q.w, q.x, q.y, q.z) * turn.spin;
  return {{T::narrow(q.w), T::narrow(q.x), T::narrow(q.y), T::narrow(q.z)},
          {T::narrow(turned.x), T::narrow(turned.y), T::narrow(turned.z)}};
}

template <class Mask, class V>
PBMPI_LANES QuatL<V> chosen(const Mask& first, const QuatL<V>& a, const QuatL<V>& b) {
  return {first ? a.w : b.w, first ? a.x : b.x, first ? a.y : b.y, first ? a.z : b.z};
}

}  // namespace turning_detail

/// Moves a body for `h` [s]. Lanes that have a gyroscopic torque (`has_torque` 1, else 0) turn under their
/// own inertia alone, the others keep their angular velocity to the bit. Also sets the rotation.
///
/// `exact`: 1 in the lanes whose joints are solved exactly, else 0. Nothing takes energy there, so that these
/// turn in double precision. In single precision a turn by less than 3e-4 rad, whose cosine is 1, lengthens
/// what it turns, and a quaternion whose length is rounded scales it: in each substep by some 1e-8 to the
/// same side, in a minute by 1 %.
template <class T, bool last>
PBMPI_LANES void integrate_turning(const PrincipalInertia<typename T::V>& inertia, typename T::Scalar h,
                                   const typename T::V& has_torque, const typename T::V& exact,
                                   BodyLane<typename T::V>& body, Twist<typename T::V>& twist) {
  using V = typename T::V;
  using namespace turning_detail;
  const QuatL<V> from{body.qw, body.qx, body.qy, body.qz};
  const V zero = T::broadcast(0);
  FreeTurn<V> turn = turn_freely<T>(inertia, h, from, body.rotation, twist.angular), wide = turn;
  turn.orientation = unit<T>(turn.orientation);
  const bool is_careful = sizeof(typename T::Scalar) < sizeof(double) && T::any(exact);
  if (is_careful) {
    wide = turn_widely<T>(inertia, h, from, twist.angular);
    turn.orientation = chosen(exact > zero, wide.orientation, turn.orientation);
  }
  integrate<T, last>(body, twist, h);
  const auto has = has_torque > zero;
  const QuatL<V> to = chosen(has, turn.orientation, QuatL<V>{body.qw, body.qx, body.qy, body.qz});
  body.qw = to.w;
  body.qx = to.x;
  body.qy = to.y;
  body.qz = to.z;
  body.rotation = to_matrix(body.qw, body.qx, body.qy, body.qz);
  Vec3L<V> turned = body.rotation * turn.spin;
  if (is_careful) turned = chosen(exact > zero, wide.spin, turned);
  twist.angular = chosen(has, turned, twist.angular);
}

}  // namespace pbmpi::solver
