#include "geometry/ray_cast.h"

#include <algorithm>
#include <cmath>

#include "geometry/triangle_mesh.h"

namespace pbmpi::geometry {
namespace {

/// The part of an infinite line that lies in a convex shape, in shares of the path; empty if enter > leave.
struct Inside {
  double enter = -model::infinity;
  double leave = model::infinity;
  core::Vec3 normal = core::Vec3::Zero();  ///< where it enters
};

Inside nowhere() { return {model::infinity, -model::infinity, core::Vec3::Zero()}; }

Inside both(const Inside& a, const Inside& b) {
  return {std::max(a.enter, b.enter), std::min(a.leave, b.leave), a.enter >= b.enter ? a.normal : b.normal};
}

/// The part between -half and half along `axis`.
Inside slab(const core::Vec3& from, const core::Vec3& way, int axis, double half) {
  const double start = from[axis], rate = way[axis];
  if (rate == 0) return std::abs(start) <= half ? Inside{} : nowhere();
  const double low = (-half - start) / rate, high = (half - start) / rate;
  return {std::min(low, high), std::max(low, high), core::Vec3::Unit(axis) * (rate > 0 ? -1.0 : 1.0)};
}

/// The part within `radius` of a point or a line; `offset` and `way` have no components along that line.
Inside round(const core::Vec3& offset, const core::Vec3& way, double radius) {
  const double a = way.squaredNorm(), b = offset.dot(way), c = offset.squaredNorm() - radius * radius;
  if (a == 0) return c <= 0 ? Inside{} : nowhere();
  const double discriminant = b * b - a * c;
  if (!(discriminant >= 0)) return nowhere();
  const double root = std::sqrt(discriminant);
  const double enter = (-b - root) / a;
  return {enter, (-b + root) / a, (offset + enter * way) / radius};
}

/// The part below the plane of a hull's face.
Inside below(const core::Vec3& from, const core::Vec3& way, const model::Hull::Face& face) {
  const double start = face.normal.dot(from) - face.height, rate = face.normal.dot(way);
  if (rate == 0) return start <= 0 ? Inside{} : nowhere();
  Inside part;
  (rate < 0 ? part.enter : part.leave) = -start / rate;
  part.normal = face.normal;
  return part;
}

Inside hull(const core::Vec3& from, const core::Vec3& way, const model::Hull& hull) {
  Inside all;
  for (const model::Hull::Face& face : hull.faces) all = both(all, below(from, way, face));
  return all;
}

/// A path comes through the front of a triangle, and is inside from there on.
Inside mesh(const core::Vec3& from, const core::Vec3& way, const TriangleMesh& mesh) {
  const auto hit = mesh.first_hit(from, way);
  if (!hit) return nowhere();
  return {hit->share, model::infinity, mesh.surface.faces[static_cast<std::size_t>(hit->triangle)].normal};
}

core::Vec3 without_z(const core::Vec3& v) { return {v.x(), v.y(), 0}; }

/// A capsule is the union of a cylinder and two balls, and convex: the line enters it where it first enters
/// one of them, and leaves it where it leaves the last.
Inside capsule(const core::Vec3& from, const core::Vec3& way, double radius, double half) {
  Inside all = both(round(without_z(from), without_z(way), radius), slab(from, way, 2, half));
  if (!(all.enter <= all.leave)) all = nowhere();
  for (const double end : {-half, half}) {
    const Inside ball = round(from - end * core::Vec3::UnitZ(), way, radius);
    if (!(ball.enter <= ball.leave)) continue;
    if (ball.enter < all.enter) {
      all.enter = ball.enter;
      all.normal = ball.normal;
    }
    all.leave = std::max(all.leave, ball.leave);
  }
  return all;
}

/// The part inside the geom, in the geom's own frame.
Inside inside(const model::Geom& geom, const core::Vec3& from, const core::Vec3& way) {
  switch (geom.shape) {
    case model::Shape::plane:
      if (!(way.z() < 0)) return nowhere();
      return {-from.z() / way.z(), model::infinity, core::Vec3::UnitZ()};
    case model::Shape::sphere:
      return round(from, way, geom.size[0]);
    case model::Shape::box:
      return both(both(slab(from, way, 0, geom.size[0] / 2), slab(from, way, 1, geom.size[1] / 2)),
                  slab(from, way, 2, geom.size[2] / 2));
    case model::Shape::cylinder:
      return both(round(without_z(from), without_z(way), geom.size[0]), slab(from, way, 2, geom.size[1] / 2));
    case model::Shape::capsule:
      return capsule(from, way, geom.size[0], geom.size[1] / 2);
    case model::Shape::hull:
      return hull(from, way, *geom.hull);
    case model::Shape::mesh:
      return mesh(from, way, *geom.mesh);
  }
  return nowhere();
}

}  // namespace

std::optional<Entry> enter(const model::Geom& geom, const model::BodyPose& pose, const core::Vec3& from,
                           const core::Vec3& way) {
  using RowMajor = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
  const Eigen::Map<const RowMajor> rotation(pose.rotation);
  const core::Vec3 local_from = rotation.transpose() * (from - core::Vec3(pose.position));
  const core::Vec3 local_way = rotation.transpose() * way;
  const Inside found = inside(geom, local_from, local_way);
  const bool comes_in = found.enter >= 0 && found.enter <= 1 && found.enter <= found.leave;
  if (!comes_in) return std::nullopt;
  return Entry{found.enter, rotation * found.normal};
}

}  // namespace pbmpi::geometry
