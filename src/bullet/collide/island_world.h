/// Bullet's world, stepped phase by phase.
#pragma once

#include "bullet/collide/collider.h"
#include "bullet/objects/axis_joints.h"

namespace pbmpi::bullet {

/// btDiscreteDynamicsWorld without its own collision detection: the contacts of a step are those that the
/// collider's dispatcher has. stepSimulation() finds islands by the pairs of its broad phase, which has a
/// history; here contacts and joints alone connect them.
class IslandWorld final : private btDiscreteDynamicsWorld {
 public:
  /// All are borrowed, and outlive this world.
  IslandWorld(const model::Model& model, Bodies& bodies, AxisJoints& joints, Collider& collider,
              btBroadphaseInterface& no_pairs);

  /// Forces, islands, solver, poses: a step of `dt_s` by so many iterations.
  void step(double dt_s, int iterations);
  const btDispatcherInfo& collision_info() const { return getDispatchInfo(); }

 private:
  void calculateSimulationIslands() override;
};

}  // namespace pbmpi::bullet
