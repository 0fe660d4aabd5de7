#include "geometry/solid.h"

#include <algorithm>
#include <cmath>

namespace pbmpi::geometry {
namespace {

using model::Shape;

core::Vec3 in_frame_of(const Solid& solid, const core::Vec3& point) {
  return solid.axes.transpose() * (point - solid.centre);
}

void add_normal(NormalCone& cone, const core::Vec3& normal) {
  cone.edge[static_cast<std::size_t>(cone.count++)] = normal;
}

/// Adds a face at `limit` if the point is near it. False if the point is outside of it.
bool look_at_face(double place, double limit, double tolerance, const core::Vec3& normal, NormalCone& cone) {
  if (!(place <= limit + tolerance)) return false;
  if (place >= limit - tolerance) add_normal(cone, normal);
  return true;
}

/// The face of the box of Extent::half that is nearest along axis k.
bool look_along(const Solid& solid, const core::Vec3& at, int k, double tolerance, NormalCone& cone) {
  const double sign = at[k] < 0 ? -1 : 1;
  return look_at_face(std::abs(at[k]), solid.extent.half[static_cast<std::size_t>(k)], tolerance,
                      sign * solid.axes.col(k), cone);
}

/// The surface at `radius` about an axis or a point, `offset` away from it.
bool look_around(const Solid& solid, const core::Vec3& offset, double radius, double tolerance,
                 NormalCone& cone) {
  const double length = offset.norm();
  const core::Vec3 outward = length > 0 ? core::Vec3(offset / length) : core::Vec3::UnitX();
  return look_at_face(length, radius, tolerance, solid.axes * outward, cone);
}

core::Vec3 across_z(const core::Vec3& v) { return {v.x(), v.y(), 0}; }

double half_z(const Solid& solid) { return solid.extent.half[2]; }

/// Moves the point onto the box's faces towards which the normal leans. Returns how many these are.
int move_to_faces(const Solid& solid, const core::Vec3& normal, core::Vec3& at, Face& face) {
  int leans = 0;
  for (int k = 0; k < 3; ++k) {
    const double half = solid.extent.half[static_cast<std::size_t>(k)];
    const double sign = normal[k] < 0 ? -1 : 1;
    const bool reaches = std::abs(normal[k]) > least_lean;
    at[k] = reaches ? sign * half : std::clamp(at[k], -half, half);
    if (!reaches) continue;
    face = {k, sign};
    ++leans;
  }
  return leans;
}

Support::Kind move_to_cylinder(const Solid& solid, const core::Vec3& normal, core::Vec3& at, Face& face) {
  const double radius = solid.extent.disc, half = half_z(solid), sign = normal.z() < 0 ? -1 : 1;
  const core::Vec3 aside = across_z(normal);
  const bool to_end = std::abs(normal.z()) > least_lean, to_side = aside.norm() > least_lean;
  const double off_axis = across_z(at).norm();
  const core::Vec3 within = across_z(at) * std::min(1.0, radius / std::max(off_axis, radius));
  const core::Vec3 place = to_side ? core::Vec3(radius / aside.norm() * aside) : within;
  at = {place.x(), place.y(), to_end ? sign * half : std::clamp(at.z(), -half, half)};
  face = {2, sign};
  if (to_end && to_side) return Support::Kind::edge;
  return to_end ? Support::Kind::face : Support::Kind::round;
}

}  // namespace

double Solid::half_along(const core::Vec3& direction) const {
  const core::Vec3 along = axes.transpose() * direction;
  if (hull != nullptr) {
    double most = 0;
    for (const core::Vec3& vertex : hull->vertices) most = std::max(most, along.dot(vertex));
    return most;
  }
  double half = extent.ball;
  for (int k = 0; k < 3; ++k) half += std::abs(along[k]) * extent.half[static_cast<std::size_t>(k)];
  return half + extent.disc * across_z(along).norm();
}

Solid solid_at(const model::Geom& geom, const model::BodyPose& pose) {
  using RowMajor = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
  return {geom.shape, core::Vec3(pose.position), Eigen::Map<const RowMajor>(pose.rotation), extent_of(geom),
          geom.hull.get()};
}

Faces faces_of(const Solid& solid) {
  Faces faces;
  const auto add_pair = [&](int axis) {
    for (const double sign : {1.0, -1.0}) faces.faces[static_cast<std::size_t>(faces.count++)] = {axis, sign};
  };
  if (solid.shape == Shape::box) {
    for (int axis = 0; axis < 3; ++axis) add_pair(axis);
  } else if (solid.shape == Shape::cylinder) {
    add_pair(2);
  }
  return faces;
}

int index_of(const Solid& solid, const Face& face) {
  return (solid.shape == Shape::box ? 2 * face.axis : 0) + (face.sign < 0 ? 1 : 0);
}

bool NormalCone::holds(const core::Vec3& normal) const {
  core::Vec3 rest = normal;
  for (int i = 0; i < count; ++i) {
    const core::Vec3& own = edge[static_cast<std::size_t>(i)];
    const double share = own.dot(normal);
    if (share < -least_lean) return false;
    rest -= share * own;
  }
  return rest.squaredNorm() <= least_lean * least_lean;
}

std::optional<NormalCone> normals_at(const Solid& solid, const core::Vec3& point, double tolerance) {
  const core::Vec3 at = in_frame_of(solid, point);
  NormalCone cone;
  bool within = true;
  switch (solid.shape) {
    case Shape::plane:
      within = look_at_face(at.z(), 0, tolerance, solid.axes.col(2), cone);
      break;
    case Shape::sphere:
      within = look_around(solid, at, solid.extent.ball, tolerance, cone);
      break;
    case Shape::capsule: {
      const double along = std::clamp(at.z(), -half_z(solid), half_z(solid));
      within = look_around(solid, at - along * core::Vec3::UnitZ(), solid.extent.ball, tolerance, cone);
      break;
    }
    case Shape::cylinder:
      within = look_along(solid, at, 2, tolerance, cone) &&
               look_around(solid, across_z(at), solid.extent.disc, tolerance, cone);
      break;
    case Shape::box:
      for (int k = 0; k < 3; ++k) within = within && look_along(solid, at, k, tolerance, cone);
      break;
    case Shape::hull:  // never part of a solid of several (Seams)
    case Shape::mesh:
      within = false;
      break;
  }
  return within ? std::optional(cone) : std::nullopt;
}

Support support_at(const Solid& solid, const core::Vec3& outward, const core::Vec3& near) {
  const core::Vec3 normal = solid.axes.transpose() * outward;
  core::Vec3 at = in_frame_of(solid, near);
  Support support;
  if (solid.shape == Shape::box) {
    const int leans = move_to_faces(solid, normal, at, support.face);
    support.kind = leans == 1 ? Support::Kind::face : Support::Kind::edge;
  } else if (solid.shape == Shape::cylinder) {
    support.kind = move_to_cylinder(solid, normal, at, support.face);
  } else {
    const double along = std::clamp(at.z(), -half_z(solid), half_z(solid));  // a sphere's half is 0
    support.kind = Support::Kind::round;
    at = along * core::Vec3::UnitZ() + solid.extent.ball * normal;
  }
  support.point = solid.centre + solid.axes * at;
  return support;
}

}  // namespace pbmpi::geometry
