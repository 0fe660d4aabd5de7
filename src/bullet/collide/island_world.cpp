#include "bullet/collide/island_world.h"

#include <BulletCollision/CollisionDispatch/btSimulationIslandManager.h>

namespace pbmpi::bullet {
namespace {

bool moves(const btCollisionObject* object) { return !object->isStaticOrKinematicObject(); }

}  // namespace

IslandWorld::IslandWorld(const model::Model& model, Bodies& bodies, AxisJoints& joints, Collider& collider,
                         btBroadphaseInterface& no_pairs)
    : btDiscreteDynamicsWorld(&collider.dispatcher(), &no_pairs, &collider.solver(), nullptr) {
  setGravity(to_bullet(model.gravity));
  for (int body = 0; body < bodies.size(); ++body) addRigidBody(&bodies[body]);
  for (int joint = 0; joint < joints.size(); ++joint) addConstraint(&joints[joint]);
  btContactSolverInfo& info = getSolverInfo();
  info.m_erp = model.erp;
  info.m_erp2 = model.contact_law.soft_erp;
  info.m_restitutionVelocityThreshold = model.contact_law.bounce_velocity;
  // Two friction directions, as in ODE: with one, friction holds a body at rest only along that direction.
  // Contacts are new in each step, so the "warm start" begins at zero; without it no impulses are written
  // back.
  info.m_solverMode = SOLVER_USE_WARMSTARTING | SOLVER_SIMD | SOLVER_USE_2_FRICTION_DIRECTIONS;
}

void IslandWorld::step(double dt_s, int iterations) {
  getSolverInfo().m_timeStep = dt_s;
  getSolverInfo().m_numIterations = iterations;
  applyGravity();
  calculateSimulationIslands();
  solveConstraints(getSolverInfo());
  integrateTransforms(dt_s);
  clearForces();
}

void IslandWorld::calculateSimulationIslands() {
  btSimulationIslandManager& islands = *getSimulationIslandManager();
  islands.updateActivationState(this, getDispatcher());
  const auto unite = [&](const btCollisionObject* a, const btCollisionObject* b) {
    if (moves(a) && moves(b)) islands.getUnionFind().unite(a->getIslandTag(), b->getIslandTag());
  };
  for (int i = 0; i < getDispatcher()->getNumManifolds(); ++i) {
    const btPersistentManifold& contact = *getDispatcher()->getManifoldByIndexInternal(i);
    unite(contact.getBody0(), contact.getBody1());
  }
  for (int i = 0; i < getNumConstraints(); ++i) {
    const btTypedConstraint& joint = *getConstraint(i);
    if (joint.isEnabled()) unite(&joint.getRigidBodyA(), &joint.getRigidBodyB());
  }
  islands.storeIslandActivationState(this);
}

}  // namespace pbmpi::bullet
