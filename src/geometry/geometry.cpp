#include "geometry/geometry.h"

#include <cmath>

#include "core/error.h"

namespace pbmpi::geometry {

bool is_ball(const model::Geom& geom) {
  return geom.shape == model::Shape::sphere && geom.local.position.isZero(0);
}

void to_rotation(double w, double x, double y, double z, double rotation[9]) {
  const double xx = 2 * x * x, yy = 2 * y * y, zz = 2 * z * z;
  rotation[0] = 1 - yy - zz;
  rotation[1] = 2 * (x * y - w * z);
  rotation[2] = 2 * (x * z + w * y);
  rotation[3] = 2 * (x * y + w * z);
  rotation[4] = 1 - xx - zz;
  rotation[5] = 2 * (y * z - w * x);
  rotation[6] = 2 * (x * z - w * y);
  rotation[7] = 2 * (y * z + w * x);
  rotation[8] = 1 - xx - yy;
}

model::BodyPose static_pose() { return {{0, 0, 0}, {1, 0, 0, 0, 1, 0, 0, 0, 1}}; }

model::BodyPose geom_pose(const model::Geom& geom, const model::BodyPose& body) {
  const core::Quat& q = geom.local.orientation;
  double local[9];
  to_rotation(q.w, q.x, q.y, q.z, local);
  model::BodyPose pose;
  for (int row = 0; row < 3; ++row) {
    const double* r = body.rotation + 3 * row;
    pose.position[row] = body.position[row] + r[0] * geom.local.position.x() +
                         r[1] * geom.local.position.y() + r[2] * geom.local.position.z();
    for (int col = 0; col < 3; ++col) {
      pose.rotation[3 * row + col] = r[0] * local[col] + r[1] * local[3 + col] + r[2] * local[6 + col];
    }
  }
  return pose;
}

std::array<double, 3> half_extents(const model::Geom& geom, const double r[9]) {
  std::array<double, 3> half{};
  for (std::size_t k = 0; k < 3; ++k) {
    const double* row = r + 3 * k;
    switch (geom.shape) {
      case model::Shape::sphere:
        half[k] = geom.size[0];
        break;
      case model::Shape::box:
        half[k] = 0.5 * (std::abs(row[0]) * geom.size[0] + std::abs(row[1]) * geom.size[1] +
                         std::abs(row[2]) * geom.size[2]);
        break;
      case model::Shape::capsule:
        half[k] = geom.size[0] + 0.5 * geom.size[1] * std::abs(row[2]);
        break;
      case model::Shape::cylinder:  // two discs of radius r at +-length/2 along z
        half[k] = 0.5 * geom.size[1] * std::abs(row[2]) +
                  geom.size[0] * std::sqrt(std::max(0.0, 1 - row[2] * row[2]));
        break;
      case model::Shape::plane:
        core::require_invariant(false, "half_extents() of a plane, which has no end");
    }
  }
  return half;
}

double bounding_radius(const model::Geom& geom) {
  const double half_length = geom.size[1] / 2;
  switch (geom.shape) {
    case model::Shape::sphere:
      return geom.size[0];
    case model::Shape::capsule:
      return geom.size[0] + half_length;
    case model::Shape::box:
      return core::Vec3(geom.size[0], geom.size[1], geom.size[2]).norm() / 2;
    case model::Shape::cylinder:
      return std::hypot(geom.size[0], half_length);
    case model::Shape::plane:
      break;
  }
  return model::infinity;
}

}  // namespace pbmpi::geometry
