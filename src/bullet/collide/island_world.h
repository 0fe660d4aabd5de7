/// Bullet's world, stepped one phase at a time.
#pragma once

#include "bullet/collide/collider.h"
#include "bullet/objects/axis_joints.h"

namespace pbmpi::bullet {

/// btDiscreteDynamicsWorld without its own collision detection: the contacts of a step are those in the
/// collider's dispatcher. stepSimulation() would find islands from the pairs of its broad phase, which depend
/// on history; here only contacts and joints connect them.
class IslandWorld final : private btDiscreteDynamicsWorld {
 public:
  /// All are borrowed and must outlive this world.
  IslandWorld(const model::Model& model, Bodies& bodies, AxisJoints& joints, Collider& collider,
              btBroadphaseInterface& no_pairs);

  /// Applies forces, finds islands, solves, and moves poses: a step of `dt_s` with this many iterations.
  void step(double dt_s, int iterations);
  const btDispatcherInfo& collision_info() const { return getDispatchInfo(); }

 private:
  void calculateSimulationIslands() override;
};

}  // namespace pbmpi::bullet
