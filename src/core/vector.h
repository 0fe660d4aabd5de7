/// Vectors, quaternions and rigid transforms in the world's and the bodies' frames.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace pbmpi::core {

/// Three components, contiguous: a std::vector<Vec3> is an array [n][3] of doubles.
using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;

/// A rotation as a unit quaternion, stored (w, x, y, z) as in ODE and in the files (Eigen stores x, y, z, w).
struct Quat {
  double w = 1, x = 0, y = 0, z = 0;

  static Quat from_eigen(const Eigen::Quaterniond& q) { return {q.w(), q.x(), q.y(), q.z()}; }
  Eigen::Quaterniond to_eigen() const { return {w, x, y, z}; }
  bool operator==(const Quat&) const = default;
};
static_assert(sizeof(Vec3) == 3 * sizeof(double) && sizeof(Quat) == 4 * sizeof(double));

/// Position [m] and orientation of one frame in another.
struct Pose {
  Vec3 position = Vec3::Zero();
  Quat orientation;

  /// Transforms a point from this frame to the outer frame [m].
  Vec3 point_to_outer(const Vec3& local) const { return position + orientation.to_eigen() * local; }
  /// Rotates a direction from this frame to the outer frame.
  Vec3 direction_to_outer(const Vec3& local) const { return orientation.to_eigen() * local; }
};

}  // namespace pbmpi::core
