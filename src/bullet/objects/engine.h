/// Bullet's headers, and conversions between its numbers and pbmpi's.
#pragma once

#include <type_traits>

#include <btBulletDynamicsCommon.h>

#include "model/model.h"

namespace pbmpi::bullet {

static_assert(std::is_same_v<btScalar, double>,
              "Bullet's headers have the wrong precision: double wants BT_USE_DOUBLE_PRECISION and the "
              "libraries *-float64 (Debian: libbullet-dev)");

inline btVector3 to_bullet(const model::Vec3& v) { return {v.x(), v.y(), v.z()}; }
inline model::Vec3 vec3(const btVector3& v) { return {v.x(), v.y(), v.z()}; }
inline btQuaternion to_bullet(const model::Quat& q) { return {q.x, q.y, q.z, q.w}; }
inline btTransform to_bullet(const model::Pose& pose) {
  return btTransform(to_bullet(pose.orientation), to_bullet(pose.position));
}

}  // namespace pbmpi::bullet
