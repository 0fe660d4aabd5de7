/// Rows of contacts in lanes. A slot holds manifolds of which no two touch the same body, so that its lanes
/// can be solved at once.
#pragma once

#include <cstdint>
#include <type_traits>

#include "solver/layout/body_lanes.h"
#include "solver/layout/row_law.h"

namespace pbmpi::solver {

/// Numbers that all contacts of a substep share.
///
/// push_rate [1/s]: the share of its depth that a contact is to push out in a second. A spring's follows from
/// its frequency and damping (layout/row_law.h). With the scene's ERP it is the ERP over the length of the
/// whole step: over the length of a substep it would push as many times faster as there are substeps, and
/// without relaxing sweeps nothing takes away the speed that a push gives.
/// impact_velocity [m/s]: the slowest approach, and the slowest push, that counts as an impact.
/// slip_velocity [m/s]: the slowest motion along the surface that counts as sliding, and the slowest one
/// apart that counts as opening.
template <class Scalar>
struct ContactParameters {
  Scalar h, push_rate, push_limit, soft_cfm, cfm, bounce_velocity, impact_velocity, slip_velocity, sor_factor;
  Scalar warm_start;  ///< share of the impulses that a step and a substep take over from the one before
  bool restitution;   ///< may a contact bounce?
  bool turning;       ///< may a contact turn a body? If not, rows of no kind do.
  bool keeps_depths;  ///< does a contact that carries force stay as deep, or as open, as it is?
  bool relaxes;       ///< do relaxing sweeps follow, which push nothing out? Then contacts bounce after them.
  bool cone;          ///< is friction the same in all directions? That of patches always is.
};

/// Which rows a contact has. `central`: no friction, and its normal goes through the centres of its bodies,
/// so that nothing turns them; `smooth`: no friction; `rough`: friction; `patched`: friction that the points
/// of a manifold share.
enum class ContactKind { central, smooth, rough, patched };

/// A row of a contact that turns nothing: J has its direction only.
template <class V>
struct alignas(sizeof(V)) CentralRow {
  Vec3L<V> direction;
  V scale, impulse;
};
/// A row with the angular parts of J and of M^-1 J^T, except b's where b is the environment.
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

/// Two rows of friction across a normal, at right angles.
template <class V, bool two_bodies>
struct alignas(sizeof(V)) FrictionRows {
  TurningRow<V, two_bodies> rows[2];
  V coupling;  ///< of the two, if they are solved as a block: the scale of each with the other's speed
  V slide;     ///< scale of both where what they hold slides
  V mu;
};

/// Normal and friction rows of one point of each lane's manifold.
template <class V, bool two_bodies_, ContactKind kind_>
struct alignas(sizeof(V)) ContactPoint {
  static constexpr bool two_bodies = two_bodies_;
  static constexpr ContactKind kind = kind_;
  ContactRow<V, two_bodies, kind> normal;
  V rhs;  ///< of the normal row; friction rows want 0 [m/s]
  V depth;
  V planned;  ///< [m] the depth that should be left by now
  V bounce;   ///< [m/s] the speed at which the bodies part once they have touched; 0: none, or they have
};
template <class V, bool two_bodies>
struct alignas(sizeof(V)) ContactPoint<V, two_bodies, ContactKind::rough>
    : ContactPoint<V, two_bodies, ContactKind::smooth> {
  static constexpr ContactKind kind = ContactKind::rough;
  FrictionRows<V, two_bodies> friction;
};
template <class V, bool two_bodies>
struct alignas(sizeof(V)) ContactPoint<V, two_bodies, ContactKind::patched>
    : ContactPoint<V, two_bodies, ContactKind::smooth> {
  static constexpr ContactKind kind = ContactKind::patched;
  V distance;      ///< [m] from the middle of the patch, along the surface
  Vec3L<V> lever;  ///< [m] from the middle of the patch, along the surface
};

/// The bodies of a slot's manifolds; its points are elsewhere, one after the other.
template <class T>
struct alignas(sizeof(typename T::V)) ContactSlot {
  std::int32_t row_a[T::num_lanes], row_b[T::num_lanes];  ///< in BodyLanes::contact_twists
  typename T::V inv_mass_a, inv_mass_b;
  typename T::V slides;  ///< 1 in lanes whose surfaces slide on each other, else 0
  typename T::V impact;  ///< 1 in lanes whose bodies approach, or are pushed apart, as in an impact; else 0
  int first_point = 0, num_points = 0;
};

/// Friction of all points of each lane's manifold together: a force at their middle, and a twist about the
/// normal, as in PhysX and Box3D. A patch of n points has n + 3 rows, where n points with friction have 3 n.
template <class T, bool two_bodies>
struct alignas(sizeof(typename T::V)) PatchSlot : ContactSlot<T> {
  using V = typename T::V;
  FrictionRows<V, two_bodies> friction;
  Vec3L<V> normal;
  V least_distance;         ///< [m] a load that lies closer to the middle on average cannot twist: it may be
                            ///< rounding
  Vec3L<V> turn_a, turn_b;  ///< I^-1 normal
  V twist_scale, twist;     ///< impulse [N m s] on a, against which b is turned
  // With K the 2 x 2 block of the force, k what each of its rows makes of a twist, and c = 1 / twist_scale:
  V lean[2];           ///< K^-1 k
  V free_twist_scale;  ///< 1 / (c - k K^-1 k): scale of a twist to which the force adapts
};
template <class T, bool two_bodies, ContactKind kind>
using SlotOf = std::conditional_t<kind == ContactKind::patched, PatchSlot<T, two_bodies>, ContactSlot<T>>;

}  // namespace pbmpi::solver
