/// Bullet's colliders and solver, shared by the worlds of a stepper.
#pragma once

#include <BulletCollision/CollisionDispatch/btCollisionDispatcher.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkEpaPenetrationDepthSolver.h>

#include "bullet/objects/engine.h"

namespace pbmpi::bullet {

/// Bullet's colliders and its solver, shared by the worlds of a stepper, which are stepped one after the
/// other: it holds no contact between two steps.
class Collider {
 public:
  Collider() : configuration_(small_pools()), dispatcher_(&configuration_) {
    dispatcher_.setDispatcherFlags(0);  // Contacts sets the distances at which points count
  }

  /// Holds the contacts of the present step.
  btCollisionDispatcher& dispatcher() { return dispatcher_; }
  /// Adds the points of a pair to `found`. They come from this call alone, not from earlier ones; a pair that
  /// may rest on each other gets several points at once, by turning one of the two slightly.
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
