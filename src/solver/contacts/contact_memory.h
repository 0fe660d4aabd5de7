/// What contact points take over from substep to substep, and leave to the next step.
#pragma once

#include "solver/contacts/contact_rows.h"
#include "solver/contacts/manifold_order.h"

namespace pbmpi::solver {

template <class T, bool two_bodies, ContactKind kind>
class ContactMemory {
 public:
  using V = typename T::V;
  using Scalar = typename T::Scalar;
  using Solver = ContactSolver<T, two_bodies, kind>;
  using Row = typename Solver::Row;
  using Point = typename Solver::Point;

  explicit ContactMemory(const ContactParameters<Scalar>& parameters)
      : h_(parameters.h), warm_start_(parameters.warm_start) {}

  /// Reduces the impulses to the share that the next substep takes over.
  void carry(const ContactSlot<T>& slot, Point* points) const;

  /// Writes the forces of the points to where their manifolds remember them.
  void remember(const ContactSlot<T>& slot, const Point* points, const Manifold* manifolds) const;

 private:
  Scalar h_, warm_start_;
};

template <class T, bool two_bodies, ContactKind kind>
void ContactMemory<T, two_bodies, kind>::carry(const ContactSlot<T>& slot, Point* points) const {
  const auto carried = [&](const V& impulse) {
    return warm_start_ > 0 ? impulse * T::broadcast(warm_start_) : T::broadcast(0);
  };
  for (int i = 0; i < slot.num_points; ++i) {
    points[i].normal.impulse = carried(points[i].normal.impulse);
    if constexpr (Solver::friction) {
      for (Row& row : points[i].friction) row.impulse = carried(row.impulse);
    }
  }
}

template <class T, bool two_bodies, ContactKind kind>
void ContactMemory<T, two_bodies, kind>::remember(const ContactSlot<T>& slot, const Point* points,
                                                  const Manifold* manifolds) const {
  const V per_h = T::broadcast(1 / h_), zero = T::broadcast(0);
  for (int i = 0; i < slot.num_points; ++i) {
    const Point& point = points[i];
    const V normal = point.normal.impulse * per_h;
    Vec3L<V> friction{zero, zero, zero};
    if constexpr (Solver::friction)
      // Without impulses +0, as of a contact that has no friction rows.
      friction = (friction + point.friction[0].direction * point.friction[0].impulse +
                  point.friction[1].direction * point.friction[1].impulse) *
                 per_h;
    for (int lane = 0; lane < T::num_lanes; ++lane) {
      if (i >= manifolds[lane].num_points || manifolds[lane].forces == nullptr) continue;
      model::ContactForce& force = manifolds[lane].forces[i];
      force.normal = T::get(normal, lane);
      force.friction = {T::get(friction.x, lane), T::get(friction.y, lane), T::get(friction.z, lane)};
    }
  }
}

}  // namespace pbmpi::solver
