#include "geometry/face_contact.h"

#include <algorithm>
#include <cmath>

namespace pbmpi::geometry {
namespace {

using model::Shape;

/// A corner in the face's frame: x and y along the face, z above its plane [m].
struct Outline {
  static constexpr int most = 24;
  std::array<core::Vec3, most> corners;
  int count = 0;

  void add(const core::Vec3& corner) {
    if (count < most) corners[static_cast<std::size_t>(count++)] = corner;
  }
  const core::Vec3& at(int i) const { return corners[static_cast<std::size_t>(i)]; }
};

constexpr int num_rim_corners = 8;
/// Cosines of the angles at which the corners of a rim are, from 0 in eighths of a turn; sines are those two
/// places before.
constexpr double half_root = 0.70710678118654752440;
constexpr std::array<double, num_rim_corners> rim_cosines = {1,  half_root,  0, -half_root,
                                                             -1, -half_root, 0, half_root};
core::Vec3 on_rim(int i, const core::Vec3& first, const core::Vec3& second) {
  return rim_cosines[static_cast<std::size_t>(i)] * first +
         rim_cosines[static_cast<std::size_t>((i + 6) % num_rim_corners)] * second;
}

/// A frame on a face, with a point of it.
struct FaceFrame {
  core::Vec3 origin, u, v, normal;

  FaceFrame(const Solid& solid, const Face& face)
      : u(solid.axes.col((face.axis + 1) % 3)),
        v(solid.axes.col((face.axis + 2) % 3)),
        normal(normal_of(solid, face)) {
    origin = solid.centre + solid.extent.half[static_cast<std::size_t>(face.axis)] * normal;
  }
  core::Vec3 in(const core::Vec3& point) const {
    const core::Vec3 from = point - origin;
    return {u.dot(from), v.dot(from), normal.dot(from)};
  }
  core::Vec3 out(const core::Vec3& at) const { return origin + at.x() * u + at.y() * v + at.z() * normal; }
};

/// The face of a box that looks most directly against the normal.
void outline_box(const Solid& box, const FaceFrame& frame, Outline& outline) {
  const core::Vec3 slope = box.axes.transpose() * frame.normal;
  int most = 0;
  for (int k = 1; k < 3; ++k) {
    if (std::abs(slope[k]) > std::abs(slope[most])) most = k;
  }
  const auto half = [&](int k) {
    return core::Vec3(box.extent.half[static_cast<std::size_t>(k)] * box.axes.col(k));
  };
  const core::Vec3 middle = box.centre + (slope[most] > 0 ? -1 : 1) * half(most);
  const core::Vec3 e = half((most + 1) % 3), f = half((most + 2) % 3);
  for (const core::Vec3& corner :
       {core::Vec3(-e - f), core::Vec3(e - f), core::Vec3(e + f), core::Vec3(f - e)})
    outline.add(frame.in(middle + corner));
}

/// The line of the side along which a cylinder lies, or the rim of its lower end, from the lowest point on.
void outline_cylinder(const Solid& cylinder, const FaceFrame& frame, Outline& outline) {
  constexpr double lies = 0.1;  // sine of the slope below which it lies on its side
  const core::Vec3 axis = cylinder.axes.col(2);
  const double slope = axis.dot(frame.normal);
  const core::Vec3 down = slope * axis - frame.normal;
  const core::Vec3 lowest =
      down.norm() > least_lean ? core::Vec3(down.normalized()) : core::Vec3(cylinder.axes.col(0));
  const core::Vec3 radius = cylinder.extent.disc * lowest, half = cylinder.extent.half[2] * axis;
  if (std::abs(slope) < lies) {
    outline.add(frame.in(cylinder.centre - half + radius));
    outline.add(frame.in(cylinder.centre + half + radius));
    return;
  }
  const core::Vec3 end = cylinder.centre + (slope > 0 ? -1 : 1) * half;
  for (int i = 0; i < num_rim_corners; ++i)
    outline.add(frame.in(end + on_rim(i, radius, axis.cross(radius))));
}

/// The face of a hull that looks most directly against the normal: of many corners, sixteen.
void outline_hull(const Solid& hull, const FaceFrame& frame, Outline& outline) {
  constexpr int most_corners = 16;
  const core::Vec3 towards = -(hull.axes.transpose() * frame.normal);
  const auto face = std::ranges::max_element(
      hull.hull->faces, {}, [&](const model::Hull::Face& one) { return towards.dot(one.normal); });
  const int count = std::min(face->count, most_corners);
  for (int i = 0; i < count; ++i) {
    const int at = face->first + i * face->count / count;
    const int vertex = hull.hull->corners[static_cast<std::size_t>(at)];
    outline.add(frame.in(hull.centre + hull.axes * hull.hull->vertices[static_cast<std::size_t>(vertex)]));
  }
}

Outline outline_of(const Solid& solid, const FaceFrame& frame) {
  Outline outline;
  if (solid.shape == Shape::box) {
    outline_box(solid, frame, outline);
  } else if (solid.shape == Shape::cylinder) {
    outline_cylinder(solid, frame, outline);
  } else if (solid.shape == Shape::hull) {
    outline_hull(solid, frame, outline);
  } else {
    const core::Vec3 foot = solid.centre - solid.extent.ball * frame.normal;
    const core::Vec3 half = solid.extent.half[2] * solid.axes.col(2);
    outline.add(frame.in(foot - half));
    if (solid.shape == Shape::capsule) outline.add(frame.in(foot + half));
  }
  return outline;
}

/// Keeps the part where `side` . (x, y) <= limit (Sutherland and Hodgman).
Outline cut(const Outline& in, const core::Vec3& side, double limit) {
  Outline out;
  for (int i = 0; i < in.count; ++i) {
    const core::Vec3 &from = in.at(i), &to = in.at(i + 1 == in.count ? 0 : i + 1);
    const double left = limit - side.dot(from), left_then = limit - side.dot(to);
    if (left >= 0) out.add(from);
    const bool is_last_of_line = in.count == 2 && i == 1;
    if ((left < 0) != (left_then < 0) && !is_last_of_line)
      out.add(from + left / (left - left_then) * (to - from));
  }
  return out;
}

Outline cut_to_face(Outline outline, const Solid& solid, const Face& face) {
  if (solid.shape == Shape::cylinder) {
    for (int i = 0; i < num_rim_corners; ++i)
      outline = cut(outline, on_rim(i, core::Vec3::UnitX(), core::Vec3::UnitY()), solid.extent.disc);
    return outline;
  }
  for (int k = 0; k < 2; ++k) {
    const double half = solid.extent.half[static_cast<std::size_t>((face.axis + 1 + k) % 3)];
    for (const double sign : {1.0, -1.0}) outline = cut(outline, sign * core::Vec3::Unit(k), half);
  }
  return outline;
}

/// The corner farthest from those chosen; the lowest before any is.
int next_corner(const Outline& outline, const std::array<int, FacePoints::most>& chosen, int num_chosen) {
  int best = -1;
  double most = -model::infinity;
  for (int i = 0; i < outline.count; ++i) {
    double rated = num_chosen == 0 ? -outline.at(i).z() : model::infinity;
    for (int j = 0; j < num_chosen; ++j)
      rated =
          std::min(rated, (outline.at(i) - outline.at(chosen[static_cast<std::size_t>(j)])).squaredNorm());
    if (rated > most) {
      most = rated;
      best = i;
    }
  }
  return num_chosen > 0 && !(most > 0) ? -1 : best;
}

}  // namespace

FacePoints lie_on_face(const Solid& solid, const Solid& other, const Face& face, double least_depth) {
  const FaceFrame frame(other, face);
  const Outline all = cut_to_face(outline_of(solid, frame), other, face);
  Outline deep;
  for (int i = 0; i < all.count; ++i) {
    if (-all.at(i).z() >= least_depth) deep.add(all.at(i));
  }
  std::array<int, FacePoints::most> chosen{};
  FacePoints found;
  while (found.count < FacePoints::most) {
    const int corner = next_corner(deep, chosen, found.count);
    if (corner < 0) break;
    chosen[static_cast<std::size_t>(found.count)] = corner;
    const core::Vec3& at = deep.at(corner);
    const core::Vec3 half_way(at.x(), at.y(), 0.5 * at.z());
    found.points[static_cast<std::size_t>(found.count++)] = {frame.out(half_way), -at.z()};
  }
  return found;
}

}  // namespace pbmpi::geometry
