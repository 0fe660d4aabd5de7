/// Sweeps over rows of contacts: what one changes of the velocities of two bodies, side by side in lanes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "solver/contacts/contact_rows.h"
#include "solver/contacts/sweep_order.h"

namespace pbmpi::solver {

/// Sweeps over the points of a slot.
template <class T, bool two_bodies, ContactKind kind>
class ContactSolver {
 public:
  using V = typename T::V;
  using Scalar = typename T::Scalar;
  using Row = ContactRow<V, two_bodies, kind>;
  using Point = ContactPoint<V, two_bodies, kind>;
  using Slot = SlotOf<T, two_bodies, kind>;
  using Friction = FrictionRows<V, two_bodies>;

  static constexpr bool central = kind == ContactKind::central;
  static constexpr bool friction = kind == ContactKind::rough;
  static constexpr bool patched = kind == ContactKind::patched;
  /// The part of a body's velocity that a contact can change.
  using Motion = std::conditional_t<central, Vec3L<V>, Twist<V>>;

  /// law: the law of this sweep.
  ContactSolver(const ContactParameters<Scalar>& parameters, const RowLaw<Scalar>& law)
      : normal_cfm_(parameters.soft_cfm / parameters.h),
        friction_cfm_(parameters.cfm / parameters.h),
        inverse_factor_(1 / parameters.sor_factor),
        law_(law),
        cone_(parameters.cone) {}

  /// `points`: the slot's, [slot.num_points], solved in the given order. A patch comes between them, after
  /// half of the places of the order: before or after all of them it would be a bias by which pyramids sag
  /// more. In the `last` sweep of a substep patches that slide come once more, so that friction is bounded by
  /// the normal forces that act in the end; and impacts get further rounds, since one leaves a box that
  /// falls flat a tenth to a third of its speed.
  PBMPI_LANES void solve(TwistRows<T>& twists, Slot& slot, Point* points, const SweepOrder::Points& order,
                         bool last) const {
    with_motions(twists, slot, [&](Motion& a, Motion& b) {
      for (std::size_t place = 0; place < order.size(); ++place) {
        if constexpr (patched) {
          if (place == order.size() / 2) solve_patch(slot, points, a, b, AllLanes());
        }
        if (order[place] < slot.num_points) solve_point(slot, points[order[place]], a, b, AllLanes());
      }
      if (!last) return;
      if constexpr (patched) {
        repeat(slot.slides, 1, a, b, [&](Motion& a_after, Motion& b_after, const SomeLanes& lanes) {
          solve_patch(slot, points, a_after, b_after, lanes);
        });
      }
      repeat(slot.impact, num_rounds, a, b, [&](Motion& a_after, Motion& b_after, const SomeLanes& lanes) {
        for (const int i : order) {
          if (i < slot.num_points) solve_point(slot, points[i], a_after, b_after, lanes);
        }
        if constexpr (patched) solve_patch(slot, points, a_after, b_after, lanes);
      });
    });
  }

  /// Lets the impulses that the points start with act on the bodies.
  PBMPI_LANES static void push_carried(TwistRows<T>& twists, const Slot& slot, const Point* points) {
    with_motions(twists, slot, [&](Motion& a, Motion& b) {
      for (int i = 0; i < slot.num_points; ++i) {
        push(slot, points[i].normal, points[i].normal.impulse, a, b);
        if constexpr (friction) push_friction(slot, points[i].friction, a, b);
      }
      if constexpr (patched) {
        push_friction(slot, slot.friction, a, b);
        if (slot.num_points > 1) twist(slot, slot.twist, a, b);
      }
    });
  }

  /// At the end of a substep: a contact of an impact that opens faster than `least` [m/s] hands no force on.
  /// Where it bears more than its two bodies, as below a leg with armatures, it finds its force late, and the
  /// force would go on and throw them.
  PBMPI_LANES static void forget_open(const TwistRows<T>& twists, Scalar least, Slot& slot, Point* points) {
    if (!T::any(slot.impact)) return;
    const V zero = T::broadcast(0);
    const Motion a = gather(twists, slot.row_a), b = two_bodies ? gather(twists, slot.row_b) : Motion{};
    V held = zero;
    for (int i = 0; i < slot.num_points; ++i) {
      const V opening = slot.impact > zero ? speed(points[i].normal, a, b) : zero;
      const auto opens = opening > T::broadcast(least);
      V& impulse = points[i].normal.impulse;
      impulse = opens ? zero : impulse;
      held += impulse;
      if constexpr (friction) {
        for (auto& row : points[i].friction.rows) row.impulse = opens ? zero : row.impulse;
      }
    }
    if constexpr (patched) {
      held = slot.impact > zero ? held : T::broadcast(1);
      const auto rubs = held > zero;
      for (auto& row : slot.friction.rows) row.impulse = rubs ? row.impulse : zero;
      slot.twist = rubs ? slot.twist : zero;
    }
  }

  /// After the relaxing sweeps: gives the points that bear something, which have touched, their separation
  /// speed once, and the friction that goes with it. Rounds, since friction changes the speeds of normals
  /// that do not go through a body's centre. The bodies part, so that such a point hands no force on.
  PBMPI_LANES void bounce(TwistRows<T>& twists, Slot& slot, Point* points) const {
    const V zero = T::broadcast(0);
    V any = zero, speeds[ManifoldOrder::most_points];
    for (int i = 0; i < slot.num_points; ++i) {
      speeds[i] = points[i].normal.impulse > zero ? points[i].bounce : zero;
      any = T::max(any, speeds[i]);
    }
    if (!T::any(any)) return;
    with_motions(twists, slot, [&](Motion& a, Motion& b) {
      repeat(any, num_rounds, a, b, [&](Motion& a_after, Motion& b_after, const SomeLanes& lanes) {
        for (int i = 0; i < slot.num_points; ++i) {
          solve_bounce(slot, points[i], speeds[i], a_after, b_after);
          if constexpr (friction) solve_point_friction(slot, points[i], a_after, b_after, lanes);
        }
        if constexpr (patched) solve_patch(slot, points, a_after, b_after, lanes);
      });
    });
    for (int i = 0; i < slot.num_points; ++i) {
      const auto parts = speeds[i] > zero;
      points[i].bounce = parts ? zero : points[i].bounce;
      points[i].normal.impulse = parts ? zero : points[i].normal.impulse;
    }
  }

  PBMPI_LANES static Motion gather(const TwistRows<T>& twists, const std::int32_t* at) {
    if constexpr (central) {
      return twists.gather_linear(at);
    } else {
      return twists.gather(at);
    }
  }
  /// Separation speed of the bodies along a row; `b` is not read where it is the environment.
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
  /// [rad/s] How fast a patch turns about its normal.
  PBMPI_LANES static V twist_speed(const Slot& slot, const Motion& a, const Motion& b) {
    if constexpr (two_bodies) {
      return dot(slot.normal, a.angular - b.angular);
    } else {
      return dot(slot.normal, a.angular);
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

  /// Which lanes take over a new impulse.
  struct AllLanes {
    PBMPI_LANES V operator()(const V& now, const V&) const { return now; }
  };
  struct SomeLanes {
    V flag;  ///< > 0
    PBMPI_LANES V operator()(const V& now, const V& before) const {
      return flag > T::broadcast(0) ? now : before;
    }
    PBMPI_LANES Vec3L<V> operator()(const Vec3L<V>& now, const Vec3L<V>& before) const {
      return {(*this)(now.x, before.x), (*this)(now.y, before.y), (*this)(now.z, before.z)};
    }
    PBMPI_LANES Twist<V> operator()(const Twist<V>& now, const Twist<V>& before) const {
      return {(*this)(now.linear, before.linear), (*this)(now.angular, before.angular)};
    }
  };
  /// Calls solve(a, b, lanes) `times` times for the lanes with `flag` > 0; the motions of the others keep
  /// their bits.
  template <class Solve>
  PBMPI_LANES static void repeat(const V& flag, int times, Motion& a, Motion& b, const Solve& solve) {
    if (!T::any(flag)) return;
    const SomeLanes lanes{flag};
    Motion a_after = a, b_after = b;
    for (int i = 0; i < times; ++i) solve(a_after, b_after, lanes);
    a = lanes(a_after, a);
    if constexpr (two_bodies) b = lanes(b_after, b);
  }
  template <class Lanes>
  PBMPI_LANES void solve_point(const ContactSlot<T>& slot, Point& point, Motion& a, Motion& b,
                               const Lanes& lanes) const {
    solve_normal(slot, point, a, b, lanes);
    if constexpr (friction) solve_point_friction(slot, point, a, b, lanes);
  }
  PBMPI_LANES void solve_bounce(const ContactSlot<T>& slot, Point& point, const V& bounce, Motion& a,
                                Motion& b) const {
    const V zero = T::broadcast(0);
    Row& row = point.normal;
    const V change = (bounce - speed(row, a, b)) * (row.scale * inverse_factor_);
    const V applied = bounce > zero ? T::max(change, -row.impulse) : zero;
    row.impulse += applied;
    push(slot, row, applied, a, b);
  }

  /// A gap (rhs < 0) is no spring: bodies that approach stop where they touch.
  template <class Lanes>
  PBMPI_LANES void solve_normal(const ContactSlot<T>& slot, Point& point, Motion& a, Motion& b,
                                const Lanes& lanes) const {
    const V zero = T::broadcast(0), one = T::broadcast(1);
    Row& row = point.normal;
    const V rhs = T::min(point.rhs, T::broadcast(law_.most_push));
    const V share = point.rhs < zero ? one : T::broadcast(law_.mass_share);
    const V relief = point.rhs < zero ? zero : T::broadcast(law_.relief);
    const V change =
        (rhs - speed(row, a, b) - normal_cfm_ * row.impulse) * (row.scale * share) - relief * row.impulse;
    const V impulse = lanes(T::max(row.impulse + change, zero), row.impulse);
    const V applied = impulse - row.impulse;
    row.impulse = impulse;
    push(slot, row, applied, a, b);
  }

  /// Force and twist are bounded by a ball once the twist is divided by the mean distance of the load from
  /// the patch's middle: an ellipsoid for the limit surface (R. Howe and M. Cutkosky, IJRR 1996). While the
  /// patch sticks, they are solved as a block, since a patch off its body's centre couples them. Where it
  /// slips, a step along the velocity in the metric of that ball has maximum dissipation as its fixed point;
  /// it goes on to the bound, as a few sweeps must do for all of a short impact.
  template <class Lanes>
  PBMPI_LANES void solve_patch(Slot& slot, const Point* points, Motion& a, Motion& b,
                               const Lanes& lanes) const {
    const V zero = T::broadcast(0), one = T::broadcast(1);
    V force = zero, torque = zero;
    for (int i = 0; i < slot.num_points; ++i) {
      force += points[i].normal.impulse;
      torque += points[i].normal.impulse * points[i].distance;
    }
    const V bound = friction_bound(slot.friction, force);
    if (slot.num_points == 1) {
      solve_friction(slot, slot.friction, bound, a, b, lanes);
      return;
    }
    Row &row0 = slot.friction.rows[0], &row1 = slot.friction.rows[1];
    const V distance = torque / (force > zero ? force : one);
    const auto twists = distance > slot.least_distance;
    const V per_distance = twists ? 1 / (twists ? distance : one) : zero;
    const FreeFriction free = free_friction(slot.friction, a, b);
    const V spin = twist_speed(slot, a, b) + friction_cfm_ * slot.twist;
    const V left = spin - slot.lean[0] * free.speed[0] - slot.lean[1] * free.speed[1];
    const V change = twists ? left * slot.free_twist_scale : zero;
    const V free0 = twists ? free.impulse[0] + slot.lean[0] * change : free.impulse[0];
    const V free1 = twists ? free.impulse[1] + slot.lean[1] * change : free.impulse[1];
    const V free_twist = twists ? slot.twist - change : zero;
    const V free_arm = free_twist * per_distance;
    const auto sticks = free0 * free0 + free1 * free1 + free_arm * free_arm <= bound * bound;
    const V step = twists ? T::min(slot.friction.slide, slot.twist_scale * per_distance * per_distance)
                          : slot.friction.slide;
    const V slid0 = row0.impulse - step * free.speed[0], slid1 = row1.impulse - step * free.speed[1];
    const V slid_arm = slot.twist * per_distance - step * distance * spin;
    const V square = T::max(slid0 * slid0 + slid1 * slid1 + slid_arm * slid_arm, T::broadcast(least_square));
    const V share = bound / T::sqrt(square);
    const V applied0 = lanes(sticks ? free0 : slid0 * share, row0.impulse) - row0.impulse;
    const V applied1 = lanes(sticks ? free1 : slid1 * share, row1.impulse) - row1.impulse;
    const V twisted = lanes(sticks ? free_twist : slid_arm * share * distance, slot.twist) - slot.twist;
    row0.impulse += applied0;
    row1.impulse += applied1;
    slot.twist += twisted;
    push(slot, row0, applied0, a, b);
    push(slot, row1, applied1, a, b);
    twist(slot, twisted, a, b);
  }

  /// Leaves a velocity of -0 as it is in lanes without a twist, as a slot without any twist does.
  PBMPI_LANES static void twist(const Slot& slot, const V& applied, Motion& a, Motion& b) {
    const auto turns = applied != T::broadcast(0);
    const auto add = [&](Vec3L<V>& angular, const Vec3L<V>& turn, const V& impulse) {
      angular.x = turns ? angular.x + turn.x * impulse : angular.x;
      angular.y = turns ? angular.y + turn.y * impulse : angular.y;
      angular.z = turns ? angular.z + turn.z * impulse : angular.z;
    };
    add(a.angular, slot.turn_a, applied);
    if constexpr (two_bodies) add(b.angular, slot.turn_b, -applied);
  }
  PBMPI_LANES static void push_friction(const ContactSlot<T>& slot, const Friction& friction_rows, Motion& a,
                                        Motion& b) {
    for (const auto& row : friction_rows.rows) push(slot, row, row.impulse, a, b);
  }

  /// mu may be infinite.
  PBMPI_LANES static V friction_bound(const Friction& friction_rows, const V& force) {
    return force > T::broadcast(0) ? friction_rows.mu * force : T::broadcast(0);
  }
  template <class Lanes>
  PBMPI_LANES void solve_point_friction(const ContactSlot<T>& slot, Point& point, Motion& a, Motion& b,
                                        const Lanes& lanes) const {
    const V bound = friction_bound(point.friction, point.normal.impulse);
    solve_friction(slot, point.friction, bound, a, b, lanes);
  }
  template <class Lanes>
  PBMPI_LANES void solve_friction(const ContactSlot<T>& slot, Friction& friction_rows, const V& bound,
                                  Motion& a, Motion& b, const Lanes& lanes) const {
    Row &row0 = friction_rows.rows[0], &row1 = friction_rows.rows[1];
    if (!cone_) {
      const V zero = T::broadcast(0);
      for (Row* row : {&row0, &row1}) solve_row(slot, *row, zero, friction_cfm_, -bound, bound, a, b, lanes);
      return;
    }
    apply_friction(slot, friction_rows, free_friction(friction_rows, a, b), bound, a, b, lanes);
  }

  /// Speeds along both rows of friction, and the impulses that would stop them.
  struct FreeFriction {
    V speed[2], impulse[2];
  };
  PBMPI_LANES FreeFriction free_friction(const Friction& friction_rows, const Motion& a,
                                         const Motion& b) const {
    const Row &row0 = friction_rows.rows[0], &row1 = friction_rows.rows[1];
    const V speed0 = speed(row0, a, b) + friction_cfm_ * row0.impulse;
    const V speed1 = speed(row1, a, b) + friction_cfm_ * row1.impulse;
    return {{speed0, speed1},
            {row0.impulse - row0.scale * speed0 - friction_rows.coupling * speed1,
             row1.impulse - friction_rows.coupling * speed0 - row1.scale * speed1}};
  }
  /// Where the contact slides, the impulse goes to its bound and turns against the velocity: a step of the
  /// same scale along both rows has that as its fixed point, a step of the block does not.
  template <class Lanes>
  PBMPI_LANES static void apply_friction(const ContactSlot<T>& slot, Friction& friction_rows,
                                         const FreeFriction& free, const V& bound, Motion& a, Motion& b,
                                         const Lanes& lanes) {
    Row &row0 = friction_rows.rows[0], &row1 = friction_rows.rows[1];
    const V &free0 = free.impulse[0], &free1 = free.impulse[1];
    const auto sticks = free0 * free0 + free1 * free1 <= bound * bound;
    const V slid0 = row0.impulse - friction_rows.slide * free.speed[0];
    const V slid1 = row1.impulse - friction_rows.slide * free.speed[1];
    const V square = T::max(slid0 * slid0 + slid1 * slid1, T::broadcast(least_square));
    const V share = bound / T::sqrt(square);
    const V applied0 = lanes(sticks ? free0 : slid0 * share, row0.impulse) - row0.impulse;
    const V applied1 = lanes(sticks ? free1 : slid1 * share, row1.impulse) - row1.impulse;
    row0.impulse += applied0;
    row1.impulse += applied1;
    push(slot, row0, applied0, a, b);
    push(slot, row1, applied1, a, b);
  }

  template <class Lanes>
  PBMPI_LANES static void solve_row(const ContactSlot<T>& slot, Row& row, const V& rhs, Scalar cfm,
                                    const V& low, const V& high, Motion& a, Motion& b, const Lanes& lanes) {
    const V change = (rhs - speed(row, a, b) - cfm * row.impulse) * row.scale;
    const V impulse = lanes(T::min(T::max(row.impulse + change, low), high), row.impulse);
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

  static constexpr int num_rounds = 3;  ///< of an impact beyond the first, and of a bounce
  /// [N^2 s^2] A square far below that of any impulse, so that nothing divides by 0.
  static constexpr Scalar least_square = static_cast<Scalar>(1e-30);

  Scalar normal_cfm_, friction_cfm_, inverse_factor_;
  RowLaw<Scalar> law_;
  bool cone_;
};

}  // namespace pbmpi::solver
