/// Rows of contacts in lanes. A slot holds manifolds of which no two touch the same body, so that its lanes
/// can be solved at once.
#pragma once

#include <cstdint>
#include <type_traits>

#include "solver/contacts/sweep_order.h"
#include "solver/layout/body_lanes.h"
#include "solver/layout/row_law.h"

namespace pbmpi::solver {

/// Uniform numbers of contacts in a substep.
///
/// push_rate [1/s]: the share of its depth that a contact is to push out in a second. As a spring's it
/// follows from its frequency and damping (layout/row_law.h). From the scene's ERP it is that divided by the
/// length of the whole step: divided by that of a substep it would push as many times faster as there are
/// substeps, and without relaxing sweeps nothing takes away the speed that a push gives.
template <class Scalar>
struct ContactParameters {
  Scalar h, push_rate, push_limit, soft_cfm, cfm, bounce_velocity, sor_factor;
  Scalar warm_start;  ///< share of the impulses that a step and a substep take over from the one before
  bool restitution;   ///< may a contact bounce?
  bool turning;       ///< may a contact turn a body? If not, its rows do not, of whatever kind they are.
  bool keeps_depths;  ///< does a contact that carries force stay as deep, or as open, as it is?
  bool relaxes;       ///< do sweeps follow that push nothing out? Then contacts bounce after them.
  bool cone;          ///< friction that is the same in all directions
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

/// Normal and friction rows of one point of each lane's manifold.
template <class V, bool two_bodies_, ContactKind kind_>
struct alignas(sizeof(V)) ContactPoint {
  static constexpr bool two_bodies = two_bodies_;
  static constexpr ContactKind kind = kind_;
  ContactRow<V, two_bodies, kind> normal;
  V rhs;  ///< of the normal row; friction rows want 0 [m/s]
  V depth;
  V planned;  ///< [m] the depth that should be left by now
  V bounce;   ///< [m/s] the speed at which the bodies are to part after the relaxing sweeps; 0: none
  V peak;     ///< [N s] the largest normal impulse of a substep so far
};
template <class V, bool two_bodies>
struct alignas(sizeof(V)) ContactPoint<V, two_bodies, ContactKind::rough>
    : ContactPoint<V, two_bodies, ContactKind::smooth> {
  static constexpr ContactKind kind = ContactKind::rough;
  TurningRow<V, two_bodies> friction[2];
  V coupling;  ///< of the two, if they are solved as a block: the scale of each with the other's speed
  V slide;     ///< scale of both where the point slides
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

  /// law: of this sweep.
  ContactSolver(const ContactParameters<Scalar>& parameters, const RowLaw<Scalar>& law)
      : normal_cfm_(parameters.soft_cfm / parameters.h),
        friction_cfm_(parameters.cfm / parameters.h),
        inverse_factor_(1 / parameters.sor_factor),
        law_(law),
        cone_(parameters.cone) {}

  /// `points`: those of the slot, [slot.num_points]. `order`: in which they are solved.
  PBMPI_LANES void solve(TwistRows<T>& twists, const ContactSlot<T>& slot, Point* points,
                         const SweepOrder::Points& order) const {
    with_motions(twists, slot, [&](Motion& a, Motion& b) {
      for (const int i : order) {
        if (i < slot.num_points) solve_point(slot, points[i], a, b);
      }
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

  /// After the relaxing sweeps: what has touched parts at its speed of bouncing.
  PBMPI_LANES void bounce(TwistRows<T>& twists, const ContactSlot<T>& slot, Point* points) const {
    const V zero = T::broadcast(0);
    with_motions(twists, slot, [&](Motion& a, Motion& b) {
      for (int i = 0; i < slot.num_points; ++i) {
        Row& row = points[i].normal;
        const V bounces = points[i].peak > zero ? points[i].bounce : zero;
        if (!T::any(bounces)) continue;
        const V change = (bounces - speed(row, a, b)) * (row.scale * inverse_factor_);
        const V applied = bounces > zero ? T::max(change, -row.impulse) : zero;
        row.impulse += applied;
        push(slot, row, applied, a, b);
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
    solve_normal(slot, point, a, b);
    if constexpr (friction) solve_friction(slot, point, a, b);
  }

  /// A gap (rhs < 0) is no spring: what approaches stops where it touches.
  PBMPI_LANES void solve_normal(const ContactSlot<T>& slot, Point& point, Motion& a, Motion& b) const {
    const V zero = T::broadcast(0), one = T::broadcast(1);
    Row& row = point.normal;
    const V rhs = T::min(point.rhs, T::broadcast(law_.most_push));
    const V share = point.rhs < zero ? one : T::broadcast(law_.mass_share);
    const V relief = point.rhs < zero ? zero : T::broadcast(law_.relief);
    const V change =
        (rhs - speed(row, a, b) - normal_cfm_ * row.impulse) * (row.scale * share) - relief * row.impulse;
    const V impulse = T::max(row.impulse + change, zero);
    const V applied = impulse - row.impulse;
    row.impulse = impulse;
    push(slot, row, applied, a, b);
  }

  PBMPI_LANES void solve_friction(const ContactSlot<T>& slot, Point& point, Motion& a, Motion& b) const {
    const V bound = point.mu * point.normal.impulse;
    Row &row0 = point.friction[0], &row1 = point.friction[1];
    if (!cone_) {
      const V zero = T::broadcast(0);
      for (Row* row : {&row0, &row1}) solve_row(slot, *row, zero, friction_cfm_, -bound, bound, a, b);
      return;
    }
    const V speed0 = speed(row0, a, b) + friction_cfm_ * row0.impulse;
    const V speed1 = speed(row1, a, b) + friction_cfm_ * row1.impulse;
    const V free0 = row0.impulse - row0.scale * speed0 - point.coupling * speed1;
    const V free1 = row1.impulse - point.coupling * speed0 - row1.scale * speed1;
    // Where it slides, the impulse turns against the velocity: a step of the same scale along both rows has
    // that as its fixed point, the block's has not.
    const auto sticks = free0 * free0 + free1 * free1 <= bound * bound;
    const V slid0 = row0.impulse - point.slide * speed0, slid1 = row1.impulse - point.slide * speed1;
    const V square = T::max(slid0 * slid0 + slid1 * slid1, T::broadcast(least_square));
    const V share = T::min(bound / T::sqrt(square), T::broadcast(1));
    const V applied0 = (sticks ? free0 : slid0 * share) - row0.impulse;
    const V applied1 = (sticks ? free1 : slid1 * share) - row1.impulse;
    row0.impulse += applied0;
    row1.impulse += applied1;
    push(slot, row0, applied0, a, b);
    push(slot, row1, applied1, a, b);
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

  /// Of an impulse, so that none divides by 0: its root is far below any impulse.
  static constexpr Scalar least_square = static_cast<Scalar>(1e-30);

  Scalar normal_cfm_, friction_cfm_, inverse_factor_;
  RowLaw<Scalar> law_;
  bool cone_;
};

}  // namespace pbmpi::solver
