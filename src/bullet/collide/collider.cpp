#include "bullet/collide/collider.h"

#include <BulletCollision/CollisionDispatch/btBoxBoxCollisionAlgorithm.h>
#include <BulletCollision/CollisionDispatch/btConvexConvexAlgorithm.h>
#include <BulletCollision/CollisionDispatch/btSphereSphereCollisionAlgorithm.h>

#include "bullet/collide/plane_points.h"

namespace pbmpi::bullet {

btDefaultCollisionConstructionInfo Collider::small_pools() {
  btDefaultCollisionConstructionInfo info;
  info.m_defaultMaxPersistentManifoldPoolSize = 512;  // further manifolds come from the heap
  info.m_defaultMaxCollisionAlgorithmPoolSize = 16;
  return info;
}

/// Uses Bullet's table of algorithms (btDefaultCollisionConfiguration) for the shapes that a model has. An
/// algorithm created here has its own manifold, which is destroyed with it.
void Collider::collide(const btCollisionObjectWrapper& a, const btCollisionObjectWrapper& b,
                       const btDispatcherInfo& info, btManifoldResult& found) {
  const int shape_a = a.getCollisionShape()->getShapeType(), shape_b = b.getCollisionShape()->getShapeType();
  if (shape_b == STATIC_PLANE_PROXYTYPE)
    return find_plane_points(*a.getCollisionShape(), a.getWorldTransform(), b.getWorldTransform(), found);
  btPersistentManifold* manifold = found.getPersistentManifold();
  btCollisionAlgorithmConstructionInfo with(&dispatcher_, 0);
  with.m_manifold = manifold;
  if (shape_a == BOX_SHAPE_PROXYTYPE && shape_b == BOX_SHAPE_PROXYTYPE) {
    btBoxBoxCollisionAlgorithm(manifold, with, &a, &b).processCollision(&a, &b, info, &found);
  } else if (shape_a == SPHERE_SHAPE_PROXYTYPE && shape_b == SPHERE_SHAPE_PROXYTYPE) {
    btSphereSphereCollisionAlgorithm(manifold, with, &a, &b).processCollision(&a, &b, info, &found);
  } else {
    const bool is_point = shape_a == SPHERE_SHAPE_PROXYTYPE || shape_b == SPHERE_SHAPE_PROXYTYPE;
    const int turns = is_point ? 0 : 3, enough_points = 3;  // as btDefaultCollisionConfiguration proposes
    btConvexConvexAlgorithm(manifold, with, &a, &b, &deep_, turns, enough_points)
        .processCollision(&a, &b, info, &found);
    find_face_points(a, b, found);
  }
}

}  // namespace pbmpi::bullet
