/// Contacts in lanes. A slot holds contacts of which no two touch the same body, so that its lanes can be
/// solved at once; the sweep over the slots is the same Gauss-Seidel for every number of lanes (see
/// contact_colors.h).
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "model/contact.h"
#include "solver/joint_lanes.h"

namespace pbmpi::solver {

/// One contact to be put into a lane, with where its bodies lie.
struct PlacedContact {
  const model::Contact* contact = nullptr;
  int slot_a = 0, lane_a = 0;
  int slot_b = 0, lane_b = 0;  ///< the static slot for a contact with the environment
};

/// Normal and two friction rows of up to num_lanes contacts (box friction: ODE's dContactApprox1).
template <class T>
struct alignas(sizeof(typename T::V)) ContactSlot {
  using V = typename T::V;
  std::int32_t twist_a[T::num_lanes], twist_b[T::num_lanes];
  V inv_mass_a, inv_mass_b;
  LineRow<V> normal, friction[2];
  V mu, depth;
};

/// Uniform numbers of contacts in a substep.
template <class Scalar>
struct ContactParameters {
  Scalar h, soft_erp, soft_cfm, cfm, bounce_velocity, sor_factor;
};

/// Solves slots in which every contact has friction (or none has), and a moving second body (or none has).
template <class T, bool two_bodies, bool friction>
class ContactSolver {
 public:
  using V = typename T::V;
  using Scalar = typename T::Scalar;
  using L3 = Vec3L<V>;

  /// Rows of `contacts` (up to num_lanes; the other lanes idle), before forces act on the twists (bounce
  /// looks at the speed of approach).
  static void build(const PlacedContact* contacts, int count, const BodyLanes<T>& bodies,
                    const ContactParameters<Scalar>& parameters, ContactSlot<T>& slot);

  /// Next substep: the depth that the normal speed has left, the same directions and arms, impulses at 0.
  static void advance(const BodyLanes<T>& bodies, const ContactParameters<Scalar>& parameters,
                      ContactSlot<T>& slot);

  static void solve(BodyLanes<T>& bodies, ContactSlot<T>& slot);

 private:
  static L3 gather_vector(const BodyLanes<T>& bodies, std::size_t member, const std::int32_t* index) {
    return {bodies.gather_member(member, index), bodies.gather_member(member + sizeof(V), index),
            bodies.gather_member(member + 2 * sizeof(V), index)};
  }
  static Sym3L<V> gather_inertia(const BodyLanes<T>& bodies, const std::int32_t* index) {
    constexpr std::size_t member = offsetof(BodyLane<V>, inv_inertia);
    Sym3L<V> s;
    s.xx = bodies.gather_member(member, index);
    s.xy = bodies.gather_member(member + sizeof(V), index);
    s.xz = bodies.gather_member(member + 2 * sizeof(V), index);
    s.yy = bodies.gather_member(member + 3 * sizeof(V), index);
    s.yz = bodies.gather_member(member + 4 * sizeof(V), index);
    s.zz = bodies.gather_member(member + 5 * sizeof(V), index);
    return s;
  }

  static void build_row(const L3& direction, const L3& arm_a, const L3& arm_b, const Sym3L<V>& inertia_a,
                        const Sym3L<V>& inertia_b, const ContactSlot<T>& slot, const V& cfm, const V& factor,
                        LineRow<V>& row) {
    row.direction = direction;
    row.moment_a = cross(arm_a, direction);
    row.turn_a = inertia_a * row.moment_a;
    V diagonal = slot.inv_mass_a + dot(row.moment_a, row.turn_a);
    if constexpr (two_bodies) {
      row.moment_b = -cross(arm_b, direction);
      row.turn_b = inertia_b * row.moment_b;
      diagonal += slot.inv_mass_b + dot(row.moment_b, row.turn_b);
    }
    row.cfm = cfm;
    row.scale = factor / (diagonal + cfm);
    row.rhs = row.impulse = T::broadcast(0);
  }

  static V speed(const LineRow<V>& row, const Twist<V>& a, const Twist<V>& b) {
    if constexpr (two_bodies) return relative_speed(row, a, b);
    return relative_speed(row, a);
  }

  static void solve_row(LineRow<V>& row, const V& low, const V& high, const ContactSlot<T>& slot, Twist<V>& a,
                        Twist<V>& b) {
    const V change = (row.rhs - speed(row, a, b) - row.cfm * row.impulse) * row.scale;
    const V impulse = T::min(T::max(row.impulse + change, low), high);
    const V applied = impulse - row.impulse;
    row.impulse = impulse;
    apply(row, applied, slot.inv_mass_a, a);
    if constexpr (two_bodies) apply_to_b(row, applied, slot.inv_mass_b, b);
  }
};

template <class T, bool two_bodies, bool friction>
void ContactSolver<T, two_bodies, friction>::build(const PlacedContact* contacts, int count,
                                                   const BodyLanes<T>& bodies,
                                                   const ContactParameters<Scalar>& parameters,
                                                   ContactSlot<T>& slot) {
  std::int32_t body_a[T::num_lanes], body_b[T::num_lanes];
  const V zero = T::broadcast(0);
  L3 position{zero, zero, zero}, normal{zero, zero, T::broadcast(1)};
  V restitution = zero, factor = zero;
  slot.mu = slot.depth = zero;
  for (int lane = 0; lane < T::num_lanes; ++lane) {
    const bool used = lane < count;
    const PlacedContact idle{nullptr, bodies.static_slot, lane, bodies.static_slot, lane};
    const PlacedContact& placed = used ? contacts[lane] : idle;
    slot.twist_a[lane] = BodyLanes<T>::twist_index(placed.slot_a, placed.lane_a);
    slot.twist_b[lane] = BodyLanes<T>::twist_index(placed.slot_b, placed.lane_b);
    body_a[lane] = BodyLanes<T>::body_index(placed.slot_a, placed.lane_a);
    body_b[lane] = BodyLanes<T>::body_index(placed.slot_b, placed.lane_b);
    if (!used) continue;
    const model::Contact& contact = *placed.contact;
    T::set(position.x, lane, static_cast<Scalar>(contact.position.x()));
    T::set(position.y, lane, static_cast<Scalar>(contact.position.y()));
    T::set(position.z, lane, static_cast<Scalar>(contact.position.z()));
    T::set(normal.x, lane, static_cast<Scalar>(contact.normal.x()));
    T::set(normal.y, lane, static_cast<Scalar>(contact.normal.y()));
    T::set(normal.z, lane, static_cast<Scalar>(contact.normal.z()));
    T::set(slot.depth, lane, static_cast<Scalar>(contact.depth));
    T::set(slot.mu, lane, static_cast<Scalar>(contact.mu));
    T::set(restitution, lane, static_cast<Scalar>(contact.restitution));
    T::set(factor, lane, parameters.sor_factor);
  }
  constexpr std::size_t inv_mass = offsetof(BodyLane<V>, inv_mass);
  constexpr std::size_t centre = offsetof(BodyLane<V>, position);
  const L3 arm_a = position - gather_vector(bodies, centre, body_a);
  const Sym3L<V> inertia_a = gather_inertia(bodies, body_a);
  slot.inv_mass_a = bodies.gather_member(inv_mass, body_a);
  L3 arm_b{zero, zero, zero};
  Sym3L<V> inertia_b{zero, zero, zero, zero, zero, zero};
  Twist<V> twist_b{{zero, zero, zero}, {zero, zero, zero}};
  slot.inv_mass_b = zero;
  if constexpr (two_bodies) {
    arm_b = position - gather_vector(bodies, centre, body_b);
    inertia_b = gather_inertia(bodies, body_b);
    slot.inv_mass_b = bodies.gather_member(inv_mass, body_b);
    twist_b = bodies.gather_twist(slot.twist_b);
  }
  const V soft_cfm = T::broadcast(parameters.soft_cfm / parameters.h);
  build_row(normal, arm_a, arm_b, inertia_a, inertia_b, slot, soft_cfm, factor, slot.normal);
  const V outgoing = speed(slot.normal, bodies.gather_twist(slot.twist_a), twist_b);
  const V push = (parameters.soft_erp / parameters.h) * slot.depth;
  const V bounce = outgoing < T::broadcast(-parameters.bounce_velocity) ? -restitution * outgoing : zero;
  slot.normal.rhs = T::max(push, bounce);
  if constexpr (friction) {
    L3 directions[2];
    plane_space<T>(normal, directions[0], directions[1]);
    const V cfm = T::broadcast(parameters.cfm / parameters.h);
    for (int i = 0; i < 2; ++i) {
      build_row(directions[i], arm_a, arm_b, inertia_a, inertia_b, slot, cfm, factor, slot.friction[i]);
    }
  }
}

template <class T, bool two_bodies, bool friction>
void ContactSolver<T, two_bodies, friction>::advance(const BodyLanes<T>& bodies,
                                                     const ContactParameters<Scalar>& parameters,
                                                     ContactSlot<T>& slot) {
  const Twist<V> a = bodies.gather_twist(slot.twist_a);
  const Twist<V> b = two_bodies ? bodies.gather_twist(slot.twist_b) : Twist<V>{};
  slot.depth = slot.depth - speed(slot.normal, a, b) * parameters.h;
  // A gap (negative depth) lets the bodies approach until they touch.
  const V zero = T::broadcast(0);
  const V k = slot.depth > zero ? T::broadcast(parameters.soft_erp) : T::broadcast(1);
  slot.normal.rhs = k * slot.depth / parameters.h;
  slot.normal.impulse = slot.friction[0].impulse = slot.friction[1].impulse = zero;
}

template <class T, bool two_bodies, bool friction>
void ContactSolver<T, two_bodies, friction>::solve(BodyLanes<T>& bodies, ContactSlot<T>& slot) {
  Twist<V> a = bodies.gather_twist(slot.twist_a);
  Twist<V> b{};
  if constexpr (two_bodies) b = bodies.gather_twist(slot.twist_b);
  const V zero = T::broadcast(0);
  solve_row(slot.normal, zero, T::broadcast(static_cast<Scalar>(huge_bound)), slot, a, b);
  if constexpr (friction) {
    const V bound = slot.mu * slot.normal.impulse;
    solve_row(slot.friction[0], -bound, bound, slot, a, b);
    solve_row(slot.friction[1], -bound, bound, slot, a, b);
  }
  bodies.scatter_twist(slot.twist_a, a);
  if constexpr (two_bodies) bodies.scatter_twist(slot.twist_b, b);
}

}  // namespace pbmpi::solver
