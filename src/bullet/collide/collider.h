/// What the worlds of a stepper collide and solve with.
#pragma once

#include <BulletCollision/CollisionDispatch/btCollisionDispatcher.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkEpaPenetrationDepthSolver.h>

#include "bullet/objects/engine.h"

namespace pbmpi::bullet {

/// Bullet's colliders and its solver, shared by the worlds of a stepper, which are stepped one after the
/// other: between two steps there is no contact in it.
class Collider {
 public:
  Collider() : configuration_(small_pools()), dispatcher_(&configuration_) {
    dispatcher_.setDispatcherFlags(0);  // Contacts sets the distances at which points count
  }

  /// Has the contacts of the step at hand.
  btCollisionDispatcher& dispatcher() { return dispatcher_; }
  /// Adds to `found` the points of a pair. They are those of this call alone, and not of earlier ones, so
  /// that a pair that may lie on each other gets several at once, by turning one of the two a little.
  void collide(const btCollisionObjectWrapper& a, const btCollisionObjectWrapper& b,
               const btDispatcherInfo& info, btManifoldResult& found);
  btSequentialImpulseConstraintSolver& solver() { return solver_; }

 private:
  static btDefaultCollisionConstructionInfo small_pools();

  btDefaultCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_;
  btGjkEpaPenetrationDepthSolver deep_;
  btSequentialImpulseConstraintSolver solver_;
};

}  // namespace pbmpi::bullet
