/// Bodies in lanes: a slot holds the same body of up to `num_lanes` articulations.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "solver/lanes/twist_rows.h"

namespace pbmpi::solver {

/// All of a body except its velocity. Lane vectors only, so that a lane of it can be gathered by a stride.
template <class V>
struct alignas(sizeof(V)) BodyLane {
  Vec3L<V> position;      ///< rounded to the precision of the lanes
  Vec3L<V> position_low;  ///< what single precision lacks in `position`: see move_by()
  V qw, qx, qy, qz;
  Mat3L<V> rotation;
  Sym3L<V> inv_inertia;       ///< world frame
  Sym3L<V> inv_inertia_body;  ///< body frame
  Sym3L<V> inertia_body;
  V inv_mass;
};

/// The bodies of a pack. Slot `static_slot` has no inverse mass and never moves: it is the second body of
/// whatever is attached to the world, and of idle contact lanes.
template <class T>
class BodyLanes {
 public:
  using V = typename T::V;
  using Scalar = typename T::Scalar;

  explicit BodyLanes(int num_slots)
      : static_slot(num_slots),
        twists(num_slots + 1),
        bodies(num_slots + 1),
        half_turnings(num_slots + 1, {T::broadcast(0), T::broadcast(0), T::broadcast(0)}),
        contact_twists(num_slots + 1) {
    const V zero = T::broadcast(0), one = T::broadcast(1);
    for (BodyLane<V>& body : bodies) {
      body = BodyLane<V>{};
      body.qw = one;
      body.rotation.row0.x = body.rotation.row1.y = body.rotation.row2.z = one;
    }
    for (Twist<V>& twist : twists) twist = {{zero, zero, zero}, {zero, zero, zero}};
    expected = twists;
  }

  /// Where lane `lane` of a slot's twist begins, in scalars; component c is c num_lanes farther on.
  PBMPI_LANES static std::int32_t twist_index(int slot, int lane) {
    return static_cast<std::int32_t>(slot * static_cast<int>(sizeof(Twist<V>) / sizeof(Scalar)) + lane);
  }
  PBMPI_LANES static std::int32_t body_index(int slot, int lane) {
    return static_cast<std::int32_t>(slot * static_cast<int>(sizeof(BodyLane<V>) / sizeof(Scalar)) + lane);
  }

  PBMPI_LANES Twist<V> gather_twist(const std::int32_t* index) const {
    const Scalar* base = reinterpret_cast<const Scalar*>(twists.data());
    constexpr int n = T::num_lanes;
    return {{T::gather(base, index), T::gather(base + n, index), T::gather(base + 2 * n, index)},
            {T::gather(base + 3 * n, index), T::gather(base + 4 * n, index), T::gather(base + 5 * n, index)}};
  }
  /// The lane vector at byte offset `member` (of BodyLane) of the bodies at `index`.
  PBMPI_LANES V gather_member(std::size_t member, const std::int32_t* index) const {
    return T::gather(reinterpret_cast<const Scalar*>(bodies.data()) + member / sizeof(Scalar), index);
  }

  int static_slot;
  std::vector<Twist<V>> twists;
  std::vector<BodyLane<V>> bodies;
  /// Of bodies in joints: the twists with which they are expected to move in this substep, and by how much
  /// their angular velocities will have changed [rad/s] in its middle, as they turn under their own inertia.
  std::vector<Twist<V>> expected;
  std::vector<Vec3L<V>> half_turnings;
  TwistRows<T> contact_twists;  ///< twists of the slots in contact, while contacts are swept
};

/// The rotation matrix of a unit quaternion (ODE's dQtoR).
template <class V>
PBMPI_LANES Mat3L<V> to_matrix(const V& w, const V& x, const V& y, const V& z) {
  const V qq1 = 2 * x * x, qq2 = 2 * y * y, qq3 = 2 * z * z;
  return {{1 - qq2 - qq3, 2 * (x * y - w * z), 2 * (x * z + w * y)},
          {2 * (x * y + w * z), 1 - qq1 - qq3, 2 * (y * z - w * x)},
          {2 * (x * z - w * y), 2 * (y * z + w * x), 1 - qq1 - qq2}};
}

/// R S R^T.
template <class V>
PBMPI_LANES Sym3L<V> rotated(const Mat3L<V>& r, const Sym3L<V>& s) {
  const Vec3L<V> a = s * r.row0, b = s * r.row1, c = s * r.row2;
  return {dot(r.row0, a), dot(r.row0, b), dot(r.row0, c), dot(r.row1, b), dot(r.row1, c), dot(r.row2, c)};
}

template <class V>
PBMPI_LANES void refresh_inertia(BodyLane<V>& body) {
  body.inv_inertia = rotated(body.rotation, body.inv_inertia_body);
}
template <class V>
PBMPI_LANES void refresh(BodyLane<V>& body) {
  body.rotation = to_matrix(body.qw, body.qx, body.qy, body.qz);
  refresh_inertia(body);
}

/// 1 / sqrt(square); numbers close to 1 take a few terms of the series, with an error below 4e-6.
template <class T>
PBMPI_LANES typename T::V near_inverse_root(const typename T::V& square) {
  using V = typename T::V;
  using Scalar = typename T::Scalar;
  const auto number = [](double value) { return static_cast<Scalar>(value); };
  const V excess = square - number(1);
  const V series = number(1) - excess * (number(0.5) - excess * (number(0.375) - excess * number(0.3125)));
  const auto is_far = T::abs(excess) > T::broadcast(number(0.0625));
  const V far = is_far ? T::broadcast(1) : T::broadcast(0);
  if (!T::any(far)) return series;
  return is_far ? 1 / T::sqrt(square) : series;
}

/// Adds a displacement to a coordinate, which single precision keeps in two numbers: slow bodies move in a
/// substep by less than one number's rounding, so that a settling body would be held above where its contacts
/// carry it, and creep at the speed that this leaves it. (D. E. Knuth's TwoSum, The Art of Computer
/// Programming 2, 4.2.2.) The low number is rounded so that a double holds the sum of both, and that sum
/// rounds to the high number.
template <class T>
PBMPI_LANES void move_by(typename T::V& place, typename T::V& low, const typename T::V& way) {
  using V = typename T::V;
  if constexpr (sizeof(typename T::Scalar) == sizeof(double)) {
    place += way;
  } else {
    const V change = way + low;
    const V sum = place + change;
    const V added = sum - place;
    const V lost = (place - (sum - added)) + (change - added);
    const V unit = sum * T::broadcast(0x1p-20F);
    const V left = (lost + unit) - unit;
    place = sum + left;
    low = left - (place - sum);
  }
}

/// ODE's dxStepBody without finite rotation: q += h/2 w q, normalised. `last`: the step ends here; earlier,
/// near_inverse_root() suffices to bring the quaternion's length back to 1.
template <class T, bool last>
PBMPI_LANES void integrate(BodyLane<typename T::V>& body, const Twist<typename T::V>& twist,
                           typename T::Scalar h) {
  using V = typename T::V;
  const Vec3L<V> way = twist.linear * T::broadcast(h);
  move_by<T>(body.position.x, body.position_low.x, way.x);
  move_by<T>(body.position.y, body.position_low.y, way.y);
  move_by<T>(body.position.z, body.position_low.z, way.z);
  const Vec3L<V>& w = twist.angular;
  const typename T::Scalar half = h / 2;
  const V dw = -(w.x * body.qx) - w.y * body.qy - w.z * body.qz;
  const V dx = w.x * body.qw + w.y * body.qz - w.z * body.qy;
  const V dy = w.y * body.qw - w.x * body.qz + w.z * body.qx;
  const V dz = w.x * body.qy - w.y * body.qx + w.z * body.qw;
  body.qw += half * dw;
  body.qx += half * dx;
  body.qy += half * dy;
  body.qz += half * dz;
  const V square = body.qw * body.qw + body.qx * body.qx + body.qy * body.qy + body.qz * body.qz;
  const V inverse = last ? 1 / T::sqrt(square) : near_inverse_root<T>(square);
  body.qw *= inverse;
  body.qx *= inverse;
  body.qy *= inverse;
  body.qz *= inverse;
}

/// See BodyLanes::half_turnings; `has_torque`: as above. Bounded, however fast the body turns.
template <class T>
Vec3L<typename T::V> half_turning(const BodyLane<typename T::V>& body, const typename T::V& has_torque,
                                  const Vec3L<typename T::V>& angular, typename T::Scalar half_s) {
  const Vec3L<typename T::V> half = angular * T::broadcast(half_s);
  const Vec3L<typename T::V> momentum = rotated(body.rotation, body.inertia_body) * angular;
  return body.inv_inertia * cross(momentum, half) * (has_torque / (1 + dot(half, half)));
}

/// The implicit gyroscopic torque of ODE 0.16 (Lacoursiere, "Stabilizing gyroscopic forces in rigid multibody
/// simulations", 2006): angular velocity after a torque-free step of the body's Euler equation,
///   (I + h [L]x^T) w' = L with L = I w, all in the world frame.
/// Lanes where `has_torque` is 0 keep their velocity to the bit: rounding would change a sphere's a little.
template <class T>
void apply_gyroscopic_torque(const BodyLane<typename T::V>& body, const typename T::V& has_torque,
                             Twist<typename T::V>& twist, typename T::Scalar h) {
  using V = typename T::V;
  const Sym3L<V> inertia = rotated(body.rotation, body.inertia_body);
  const Vec3L<V> momentum = inertia * twist.angular;
  const Vec3L<V> hl = momentum * T::broadcast(h);
  // Itild = I + h * (-[L]x), by rows.
  const Vec3L<V> row0{inertia.xx, inertia.xy + hl.z, inertia.xz - hl.y};
  const Vec3L<V> row1{inertia.xy - hl.z, inertia.yy, inertia.yz + hl.x};
  const Vec3L<V> row2{inertia.xz + hl.y, inertia.yz - hl.x, inertia.zz};
  // Solve Itild w' = L by Cramer's rule: the columns of the adjugate are cross products of rows.
  const Vec3L<V> c0 = cross(row1, row2), c1 = cross(row2, row0), c2 = cross(row0, row1);
  const V inverse = 1 / dot(row0, c0);
  const Vec3L<V> turned = (c0 * momentum.x + c1 * momentum.y + c2 * momentum.z) * inverse;
  const auto has = has_torque > T::broadcast(0);
  twist.angular = {has ? turned.x : twist.angular.x, has ? turned.y : twist.angular.y,
                   has ? turned.z : twist.angular.z};
}

}  // namespace pbmpi::solver
