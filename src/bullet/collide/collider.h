/// What the worlds of a stepper collide and solve with.
#pragma once

#include <BulletCollision/CollisionDispatch/btCollisionDispatcher.h>

#include "bullet/objects/engine.h"

namespace pbmpi::bullet {

/// Bullet's colliders and its solver, shared by the worlds of a stepper, which are stepped one after the
/// other: between two steps there is no contact in it.
class Collider {
 public:
  Collider()
      : many_points_(small_pools()),
        one_point_(small_pools()),
        dispatcher_(&many_points_),
        round_dispatcher_(&one_point_) {
    many_points_.setConvexConvexMultipointIterations();
    dispatcher_.setDispatcherFlags(0);  // Contacts sets the distances at which points count
  }

  /// Has the contacts of the step at hand.
  btCollisionDispatcher& dispatcher() { return dispatcher_; }
  /// Finds the algorithm for pairs that touch in one point; all others find several at once, by turning the
  /// shapes a little, since the points of earlier steps are not kept.
  btCollisionDispatcher& dispatcher_for(const btCollisionShape& a, const btCollisionShape& b) {
    const bool is_round =
        a.getShapeType() == SPHERE_SHAPE_PROXYTYPE || b.getShapeType() == SPHERE_SHAPE_PROXYTYPE;
    return is_round ? round_dispatcher_ : dispatcher_;
  }
  btSequentialImpulseConstraintSolver& solver() { return solver_; }

 private:
  static btDefaultCollisionConstructionInfo small_pools() {
    btDefaultCollisionConstructionInfo info;
    info.m_defaultMaxPersistentManifoldPoolSize = 512;  // where more are needed they come from the heap
    info.m_defaultMaxCollisionAlgorithmPoolSize = 16;
    return info;
  }

  btDefaultCollisionConfiguration many_points_, one_point_;
  btCollisionDispatcher dispatcher_, round_dispatcher_;
  btSequentialImpulseConstraintSolver solver_;
};

}  // namespace pbmpi::bullet
