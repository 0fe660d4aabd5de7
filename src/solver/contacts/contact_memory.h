/// What contact points take over from substep to substep, and leave to the next step.
#pragma once

#include "solver/contacts/contact_solver.h"
#include "solver/contacts/manifold_order.h"

namespace pbmpi::solver {

template <class T, bool two_bodies, ContactKind kind>
class ContactMemory {
 public:
  using V = typename T::V;
  using Scalar = typename T::Scalar;
  using Solver = ContactSolver<T, two_bodies, kind>;
  using Point = typename Solver::Point;
  using Slot = typename Solver::Slot;

  explicit ContactMemory(const ContactParameters<Scalar>& parameters)
      : h_(parameters.h), warm_start_(parameters.warm_start) {}

  /// Reduces the impulses to the share that the next substep takes over.
  void carry(Slot& slot, Point* points) const;

  /// Writes the forces of the points to where their manifolds remember them.
  void remember(const Slot& slot, const Point* points, const Manifold* manifolds) const;

 private:
  using L3 = Vec3L<V>;
  using Friction = typename Solver::Friction;

  PBMPI_LANES void reduce(V& impulse) const {
    impulse = warm_start_ > 0 ? impulse * T::broadcast(warm_start_) : T::broadcast(0);
  }
  /// [N s] Gives +0 if there are no impulses, like a contact without friction rows.
  PBMPI_LANES static L3 impulse_of(const Friction& friction) {
    const V zero = T::broadcast(0);
    return L3{zero, zero, zero} + friction.rows[0].direction * friction.rows[0].impulse +
           friction.rows[1].direction * friction.rows[1].impulse;
  }
  static void share_out(const Slot& slot, const Point* points, L3* impulses);

  Scalar h_, warm_start_;
};

template <class T, bool two_bodies, ContactKind kind>
void ContactMemory<T, two_bodies, kind>::carry(Slot& slot, Point* points) const {
  for (int i = 0; i < slot.num_points; ++i) {
    reduce(points[i].normal.impulse);
    if constexpr (Solver::friction) {
      for (auto& row : points[i].friction.rows) reduce(row.impulse);
    }
  }
  if constexpr (Solver::patched) {
    for (auto& row : slot.friction.rows) reduce(row.impulse);
    reduce(slot.twist);
  }
}

/// Writes the force and twist of a patch as impulses [N s] at its points [slot.num_points]. Point i gets, by
/// its normal impulse n_i,
///   n_i (c + b normal x (r_i - r)),  r = sum n_i r_i / sum n_i,
/// with c and b such that sum and torque are the patch's. A single point may get more than mu n_i, but b
/// turns none by more than 2 mu n_i: if the points that carry lie close together, part of the twist is lost,
/// and all of it within PatchSlot::least_distance, where levers may be rounding errors.
template <class T, bool two_bodies, ContactKind kind>
void ContactMemory<T, two_bodies, kind>::share_out(const Slot& slot, const Point* points, L3* impulses) {
  constexpr Scalar least_pressure = static_cast<Scalar>(1e-25);  // [N s] below any that bears something
  const V zero = T::broadcast(0), one = T::broadcast(1);
  const L3 none{zero, zero, zero}, sum = impulse_of(slot.friction);
  V pressure = zero, spread = zero, farthest = zero;
  L3 pressed = none;
  for (int i = 0; i < slot.num_points; ++i) {
    const V& carried = points[i].normal.impulse;
    pressure += carried;
    pressed = pressed + points[i].lever * carried;
  }
  const auto carries = pressure > T::broadcast(least_pressure);
  const V per_pressure = carries ? 1 / (carries ? pressure : one) : zero;
  const L3 middle = pressed * per_pressure, even = sum * per_pressure;
  for (int i = 0; i < slot.num_points; ++i) {
    const L3 lever = points[i].lever - middle;
    const V square = dot(lever, lever);
    spread += points[i].normal.impulse * square;
    farthest = points[i].normal.impulse > zero ? T::max(farthest, square) : farthest;
  }
  // b = twist / spread, or 2 mu / the farthest lever: the smaller.
  const V twist = slot.twist - dot(slot.normal, cross(middle, sum));
  const V most = 2 * slot.friction.mu * spread, length = T::sqrt(farthest) * T::abs(twist);
  const auto is_little = length <= most;
  const V least = slot.least_distance * slot.least_distance * pressure;
  const auto twists = carries ? spread > least : carries;
  const V within = is_little ? one : most / (is_little ? one : length);
  const V turning = twists ? twist * within / (twists ? spread : one) : zero;
  for (int i = 0; i < slot.num_points; ++i) {
    const L3 share = even + cross(slot.normal, points[i].lever - middle) * turning;
    impulses[i] = none + share * points[i].normal.impulse;
  }
}

template <class T, bool two_bodies, ContactKind kind>
void ContactMemory<T, two_bodies, kind>::remember(const Slot& slot, const Point* points,
                                                  const Manifold* manifolds) const {
  const V per_h = T::broadcast(1 / h_), zero = T::broadcast(0);
  L3 impulses[ManifoldOrder::most_points];
  if constexpr (Solver::patched) share_out(slot, points, impulses);
  for (int i = 0; i < slot.num_points; ++i) {
    const V normal = points[i].normal.impulse * per_h;
    L3 friction{zero, zero, zero};
    if constexpr (Solver::friction) friction = impulse_of(points[i].friction) * per_h;
    if constexpr (Solver::patched) friction = impulses[i] * per_h;
    for (int lane = 0; lane < T::num_lanes; ++lane) {
      if (i >= manifolds[lane].num_points || manifolds[lane].forces == nullptr) continue;
      model::ContactForce& force = manifolds[lane].forces[i];
      force.normal = T::get(normal, lane);
      force.friction = {T::get(friction.x, lane), T::get(friction.y, lane), T::get(friction.z, lane)};
    }
  }
}

}  // namespace pbmpi::solver
