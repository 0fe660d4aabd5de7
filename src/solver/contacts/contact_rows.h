/// Rows of contacts in lanes. A slot holds manifolds of which no two touch the same body, so that its lanes
/// can be solved at once; the sweep over the slots is the same Gauss-Seidel for every number of lanes.
#pragma once

#include <cstdint>
#include <type_traits>

#include "solver/layout/body_lanes.h"

namespace pbmpi::solver {

/// Uniform numbers of contacts in a substep.
///
/// push_rate [1/s]: the share of its depth that a contact is to push out in a second: ERP divided by the
/// length of the whole step. Divided by that of a substep it would push as many times faster as there are
/// substeps, and nothing takes away the speed that a push gives.
template <class Scalar>
struct ContactParameters {
  Scalar h, push_rate, soft_cfm, cfm, bounce_velocity, sor_factor;
  bool restitution;   ///< may a contact bounce?
  bool turning;       ///< may a contact turn a body? If not, its rows do not, of whatever kind they are.
  Scalar warm_start;  ///< share of the impulses that a substep takes over from the one before
};

/// Which rows a contact has. `central`: no friction, and its normal goes through the centres of its bodies,
/// so that nothing turns them; `smooth`: no friction; `rough`: friction.
enum class ContactKind { central, smooth, rough };

/// A row of a contact that turns nothing: J has its direction only.
template <class V>
struct alignas(sizeof(V)) CentralRow {
  Vec3L<V> direction;
  V scale, impulse;
};
/// A row with the angular parts of J and of M^-1 J^T, but for those of b where b is the environment.
template <class V, bool two_bodies>
struct alignas(sizeof(V)) TurningRow : CentralRow<V> {
  Vec3L<V> moment_a, turn_a;
};
template <class V>
struct alignas(sizeof(V)) TurningRow<V, true> : TurningRow<V, false> {
  Vec3L<V> moment_b, turn_b;  ///< with b's sign in moment_b
};
template <class V, bool two_bodies, ContactKind kind>
using ContactRow = std::conditional_t<kind == ContactKind::central, CentralRow<V>, TurningRow<V, two_bodies>>;

/// Normal and friction rows (box friction: ODE's dContactApprox1) of one point of each lane's manifold.
template <class V, bool two_bodies_, ContactKind kind_>
struct alignas(sizeof(V)) ContactPoint {
  static constexpr bool two_bodies = two_bodies_;
  static constexpr ContactKind kind = kind_;
  ContactRow<V, two_bodies, kind> normal;
  V rhs;  ///< of the normal row; friction rows want 0 [m/s]
  V depth;
  V planned;  ///< [m] the depth that should be left by now
};
template <class V, bool two_bodies>
struct alignas(sizeof(V)) ContactPoint<V, two_bodies, ContactKind::rough>
    : ContactPoint<V, two_bodies, ContactKind::smooth> {
  static constexpr ContactKind kind = ContactKind::rough;
  TurningRow<V, two_bodies> friction[2];
  V mu;
};

/// The bodies of a slot's manifolds; its points are elsewhere, one after the other.
template <class T>
struct alignas(sizeof(typename T::V)) ContactSlot {
  std::int32_t row_a[T::num_lanes], row_b[T::num_lanes];  ///< in BodyLanes::contact_twists
  typename T::V inv_mass_a, inv_mass_b;
  int first_point = 0, num_points = 0;
};

/// Sweeps over the points of a slot.
template <class T, bool two_bodies, ContactKind kind>
class ContactSolver {
 public:
  using V = typename T::V;
  using Scalar = typename T::Scalar;
  using Row = ContactRow<V, two_bodies, kind>;
  using Point = ContactPoint<V, two_bodies, kind>;

  static constexpr bool central = kind == ContactKind::central;
  static constexpr bool friction = kind == ContactKind::rough;
  /// What a contact can change of a body's velocity.
  using Motion = std::conditional_t<central, Vec3L<V>, Twist<V>>;

  explicit ContactSolver(const ContactParameters<Scalar>& parameters)
      : normal_cfm_(parameters.soft_cfm / parameters.h), friction_cfm_(parameters.cfm / parameters.h) {}

  /// `points`: those of the slot, [slot.num_points].
  PBMPI_LANES void solve(TwistRows<T>& twists, const ContactSlot<T>& slot, Point* points,
                         bool backwards) const {
    with_motions(twists, slot, [&](Motion& a, Motion& b) {
      for (int i = 0; i < slot.num_points; ++i)
        solve_point(slot, points[backwards ? slot.num_points - 1 - i : i], a, b);
    });
  }

  /// Lets the impulses that the points start with act on the bodies.
  PBMPI_LANES static void push_carried(TwistRows<T>& twists, const ContactSlot<T>& slot,
                                       const Point* points) {
    with_motions(twists, slot, [&](Motion& a, Motion& b) {
      for (int i = 0; i < slot.num_points; ++i) {
        push(slot, points[i].normal, points[i].normal.impulse, a, b);
        if constexpr (friction) {
          for (const Row& row : points[i].friction) push(slot, row, row.impulse, a, b);
        }
      }
    });
  }

  PBMPI_LANES static Motion gather(const TwistRows<T>& twists, const std::int32_t* at) {
    if constexpr (central) {
      return twists.gather_linear(at);
    } else {
      return twists.gather(at);
    }
  }
  /// How fast the bodies part along a row; `b` is not read where it is the environment.
  PBMPI_LANES static V speed(const Row& row, const Motion& a, const Motion& b) {
    if constexpr (central && two_bodies) {
      return dot(row.direction, a - b);
    } else if constexpr (central) {
      return dot(row.direction, a);
    } else if constexpr (two_bodies) {
      return dot(row.direction, a.linear - b.linear) + dot(row.moment_a, a.angular) +
             dot(row.moment_b, b.angular);
    } else {
      return dot(row.direction, a.linear) + dot(row.moment_a, a.angular);
    }
  }

 private:
  template <class Change>
  PBMPI_LANES static void with_motions(TwistRows<T>& twists, const ContactSlot<T>& slot, Change change) {
    Motion a = gather(twists, slot.row_a), b{};
    if constexpr (two_bodies) b = gather(twists, slot.row_b);
    change(a, b);
    scatter(twists, slot.row_a, a);
    if constexpr (two_bodies) scatter(twists, slot.row_b, b);
  }
  PBMPI_LANES static void scatter(TwistRows<T>& twists, const std::int32_t* at, const Motion& motion) {
    if constexpr (central) {
      twists.scatter_linear(at, motion);
    } else {
      twists.scatter(at, motion);
    }
  }

  PBMPI_LANES void solve_point(const ContactSlot<T>& slot, Point& point, Motion& a, Motion& b) const {
    const V zero = T::broadcast(0), unbounded = T::broadcast(static_cast<Scalar>(huge_bound));
    solve_row(slot, point.normal, point.rhs, normal_cfm_, zero, unbounded, a, b);
    if constexpr (friction) {
      const V bound = point.mu * point.normal.impulse;
      for (Row& row : point.friction) solve_row(slot, row, zero, friction_cfm_, -bound, bound, a, b);
    }
  }

  PBMPI_LANES static void solve_row(const ContactSlot<T>& slot, Row& row, const V& rhs, Scalar cfm,
                                    const V& low, const V& high, Motion& a, Motion& b) {
    const V change = (rhs - speed(row, a, b) - cfm * row.impulse) * row.scale;
    const V impulse = T::min(T::max(row.impulse + change, low), high);
    const V applied = impulse - row.impulse;
    row.impulse = impulse;
    push(slot, row, applied, a, b);
  }

  PBMPI_LANES static Vec3L<V>& linear(Motion& motion) {
    if constexpr (central) {
      return motion;
    } else {
      return motion.linear;
    }
  }
  PBMPI_LANES static void push(const ContactSlot<T>& slot, const Row& row, const V& applied, Motion& a,
                               Motion& b) {
    linear(a) = linear(a) + row.direction * (slot.inv_mass_a * applied);
    if constexpr (two_bodies) linear(b) = linear(b) - row.direction * (slot.inv_mass_b * applied);
    if constexpr (!central) {
      a.angular = a.angular + row.turn_a * applied;
      if constexpr (two_bodies) b.angular = b.angular + row.turn_b * applied;
    }
  }

  Scalar normal_cfm_, friction_cfm_;
};

}  // namespace pbmpi::solver
