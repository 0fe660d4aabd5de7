#include "geometry/hulls/contact_points.h"

#include <algorithm>
#include <cmath>

namespace pbmpi::geometry {
namespace {

using Kind = LeastOverlap::Kind;

/// Cosine of the angle, 1 degree, up to which a round solid's normal counts as a face's.
constexpr double lies_on_face = 0.99985;
/// Sine of the angle up to which a cylinder lies on its side, or stands on an end.
constexpr double lies = 0.02;

}  // namespace

Chosen spread(std::span<const ContactPoint> points, std::size_t first, const core::Vec3& normal) {
  Chosen chosen;
  if (points.size() <= ContactPoints::most) {
    for (std::size_t i = 0; i < points.size(); ++i) chosen.add(i);
    return chosen;
  }
  std::size_t far = 0, left = 0, right = 0;
  const core::Vec3 origin = points[first].position;
  const auto across = [&](std::size_t i) {
    const core::Vec3 from = points[i].position - origin;
    return core::Vec3(from - normal.dot(from) * normal);
  };
  double square = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double one = across(i).squaredNorm();
    if (!(one > square)) continue;
    square = one;
    far = i;
  }
  const core::Vec3 line = across(far);
  double area_left = 0, area_right = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double area = normal.dot(line.cross(across(i)));
    if (area > area_left) {
      area_left = area;
      left = i;
    }
    if (area < area_right) {
      area_right = area;
      right = i;
    }
  }
  chosen.add(first);
  if (square > 0) chosen.add(far);
  if (area_left > 0) chosen.add(left);
  if (area_right < 0) chosen.add(right);
  return chosen;
}

NearestPoints nearest_of_segments(const core::Vec3& from, const core::Vec3& way, const core::Vec3& other_from,
                                  const core::Vec3& other_way) {
  const core::Vec3 between = from - other_from;
  const double a = way.squaredNorm(), e = other_way.squaredNorm(), f = other_way.dot(between);
  const double b = way.dot(other_way), c = way.dot(between), square = a * e - b * b;
  const auto share = [](double value) { return std::clamp(value, 0.0, 1.0); };
  double s = square > 1e-12 * a * e ? share((b * f - c * e) / square) : 0.5;
  double t = e > 0 ? (b * s + f) / e : 0;
  if (t < 0 || t > 1) {
    t = share(t);
    s = a > 0 ? share((b * t - c) / a) : 0;
  }
  return {from + s * way, other_from + t * other_way};
}

void ContactFinder::cut(const core::Vec3& side, double limit) {
  cut_outline_.clear();
  const std::size_t count = outline_.size();
  for (std::size_t i = 0; i < count; ++i) {
    const core::Vec3 &from = outline_[i], &to = outline_[i + 1 == count ? 0 : i + 1];
    const double left = limit - side.dot(from), left_then = limit - side.dot(to);
    if (left >= 0) cut_outline_.push_back(from);
    const bool goes_back = count == 2 && i == 1;  // of a line
    if ((left < 0) != (left_then < 0) && !goes_back)
      cut_outline_.push_back(from + left / (left - left_then) * (to - from));
  }
  outline_.swap(cut_outline_);
}

void ContactFinder::cut_to_face(const Polyhedron& one, int face) {
  const int count = one.num_corners(face);
  for (int i = 0; i < count && !outline_.empty(); ++i) {
    const core::Vec3 &from = one.corner(face, i), &to = one.corner(face, i + 1 == count ? 0 : i + 1);
    const core::Vec3 side = (to - from).cross(one.normal(face));
    cut(side, side.dot(from));
  }
}

void ContactFinder::outline_face(const Polyhedron& one, int face) {
  outline_.clear();
  for (int i = 0; i < one.num_corners(face); ++i) outline_.push_back(one.corner(face, i));
}

void ContactFinder::choose(const core::Vec3& plane_normal, double height, double most_depth,
                           ContactPoints& found) {
  deep_.clear();
  for (const core::Vec3& point : outline_) {
    const double depth = height - plane_normal.dot(point);
    if (depth >= -margin_) deep_.push_back({point + 0.5 * depth * plane_normal, std::min(depth, most_depth)});
  }
  std::size_t deepest = 0;
  for (std::size_t i = 1; i < deep_.size(); ++i) {
    if (deep_[i].depth > deep_[deepest].depth) deepest = i;
  }
  const Chosen chosen = spread(deep_, deepest, plane_normal);
  for (int i = 0; i < chosen.count; ++i) {
    const ContactPoint& point = deep_[chosen.index[static_cast<std::size_t>(i)]];
    found.add(point.position, point.depth);
  }
}

void ContactFinder::meet(const Polyhedron& a, const Polyhedron& b, const LeastOverlap& least,
                         ContactPoints& found) {
  found.normal = least.normal();
  if (least.kind() == Kind::edges) {
    const auto ends = [](const Polyhedron& one, int edge) {
      const model::Hull::Edge& at = one.edges()[static_cast<std::size_t>(edge)];
      return std::pair(one.vertex(at.vertices[0]), one.vertex(at.vertices[1]));
    };
    const auto [from_a, to_a] = ends(a, least.first());
    const auto [from_b, to_b] = ends(b, least.second());
    const NearestPoints near = nearest_of_segments(from_a, to_a - from_a, from_b, to_b - from_b);
    add_between(near.first, near.second, least.depth(), found);
    return;
  }
  const bool face_of_a = least.kind() == Kind::face_of_a;
  const Polyhedron &reference = face_of_a ? a : b, &incident = face_of_a ? b : a;
  const core::Vec3& normal = reference.normal(least.first());
  outline_face(incident, incident.face_towards(-normal));
  cut_to_face(reference, least.first());
  choose(normal, reference.height(least.first()), least.depth(), found);
}

void ContactFinder::lie_on_plane(const Polyhedron& a, const core::Vec3& on_plane, const core::Vec3& normal,
                                 ContactPoints& found) {
  found.normal = normal;
  outline_ = a.vertices();
  choose(normal, normal.dot(on_plane), model::infinity, found);
}

void ContactFinder::lie_on_face(const Polyhedron& a, const Polyhedron& b, int face, ContactPoints& found) {
  found.normal = b.normal(face);
  outline_face(a, a.face_towards(-found.normal));
  cut_to_face(b, face);
  choose(found.normal, b.height(face), model::infinity, found);
}

void ContactFinder::lie_along_face(const Core& a, const Polyhedron& b, int face, const core::Vec3& normal,
                                   ContactPoints& found) {
  found.normal = normal;
  const core::Vec3 half = a.half * a.axis, foot = a.centre - a.radius * normal;
  outline_ = {foot - half, foot + half};
  cut_to_face(b, face);
  const core::Vec3& up = b.normal(face);
  for (const core::Vec3& point : outline_) {
    const double deep = b.height(face) - up.dot(point);
    if (deep >= -margin_) found.add(point + 0.5 * deep * up, deep);
  }
}

void ContactFinder::lie_capsule_on_face(const Core& a, const Polyhedron& b, int face, ContactPoints& found) {
  lie_along_face(a, b, face, b.normal(face), found);
  if (a.half == 0) found.count = std::min(found.count, 1);
}

void ContactFinder::lie_cylinder_on_face(const Core& a, const Polyhedron& b, int face, double most_depth,
                                         ContactPoints& found) {
  found.normal = b.normal(face);
  outline_cylinder(a, -found.normal);
  cut_to_face(b, face);
  choose(found.normal, b.height(face), most_depth, found);
}

/// On a face, or along an edge that is parallel to it, a capsule has a point at each end of what lies there.
void ContactFinder::meet_capsule(const Core& a, const Polyhedron& b, const core::Vec3& normal, double depth,
                                 ContactPoints& found) {
  const core::Vec3 half = a.half * a.axis, foot = a.centre - a.radius * normal;
  const int face = b.face_towards(normal);
  if (b.normal(face).dot(normal) > lies_on_face) {
    lie_along_face(a, b, face, normal, found);
    if (found.count > 0) return;
  }
  found.normal = normal;
  for (const model::Hull::Edge& edge : b.edges()) {
    const core::Vec3& from = b.vertex(edge.vertices[0]);
    const core::Vec3 along = b.vertex(edge.vertices[1]) - from;
    const double length = along.norm();
    const bool is_nearest = normal.dot(b.normal(edge.faces[0]) + b.normal(edge.faces[1])) > 0 &&
                            std::abs(normal.dot(from) - b.farthest(normal).height) < lies * length;
    if (!is_nearest || !(along.cross(a.axis).norm() < lies * length)) continue;
    outline_ = {foot - half, foot + half};
    cut(along, along.dot(from + along));
    cut(-along, -along.dot(from));
    for (const core::Vec3& point : outline_) {
      const core::Vec3 on_edge = from + along.dot(point - from) / (length * length) * along;
      add_between(point, on_edge, normal.dot(on_edge - point), found);
    }
    if (found.count > 0) return;
  }
  const Farthest deepest = b.farthest(normal);
  NearestPoints near{a.centre, b.vertex(deepest.vertex)};
  double least = model::infinity;
  for (const model::Hull::Edge& edge : b.edges()) {
    const core::Vec3& from = b.vertex(edge.vertices[0]);
    const NearestPoints one =
        nearest_of_segments(a.centre - half, 2 * half, from, b.vertex(edge.vertices[1]) - from);
    const core::Vec3 apart = one.first - one.second;
    if (!(apart.squaredNorm() < least)) continue;
    least = apart.squaredNorm();
    near = one;
  }
  add_between(near.first - a.radius * normal, near.first - (a.radius - depth) * normal, depth, found);
}

/// The side or the end that looks in a direction. False if it is only a point of a rim, which is the outline.
bool ContactFinder::outline_cylinder(const Core& core, const core::Vec3& towards) {
  constexpr double half_root = 0.70710678118654752440;
  const double slope = core.axis.dot(towards);
  const core::Vec3 aside = towards - slope * core.axis, half = core.half * core.axis;
  const double sine = aside.norm();
  const core::Vec3 out = core.radius * (sine > 1e-6 ? core::Vec3(aside / sine) : core.axis.unitOrthogonal());
  outline_.clear();
  if (std::abs(slope) < lies) {
    outline_ = {core.centre - half + out, core.centre + half + out};
    return true;
  }
  const core::Vec3 end = core.centre + (slope > 0 ? half : core::Vec3(-half));
  if (!(sine < 0.5)) {
    outline_ = {end + out};
    return false;
  }
  const core::Vec3 beside = core.axis.cross(out);
  for (const auto& [x, y] : {std::pair(1.0, 0.0),
                             {half_root, half_root},
                             {0.0, 1.0},
                             {-half_root, half_root},
                             {-1.0, 0.0},
                             {-half_root, -half_root},
                             {0.0, -1.0},
                             {half_root, -half_root}})
    outline_.push_back(end + x * out + y * beside);
  return true;
}

void ContactFinder::meet_cylinder(const Core& a, const Polyhedron& b, const LeastOverlap& least,
                                  ContactPoints& found) {
  const core::Vec3& normal = least.normal();
  found.normal = normal;
  if (least.kind() == Kind::face_of_b) {
    lie_cylinder_on_face(a, b, least.first(), least.depth(), found);
    if (found.count > 0) return;
  }
  if (least.kind() == Kind::face_of_a) {  // the face of b that looks at the end, within its rim
    outline_face(b, b.face_towards(normal));
    const core::Vec3 x = a.axis.unitOrthogonal(), y = a.axis.cross(x);
    for (const core::Vec3& side : {x, y, core::Vec3(-x), core::Vec3(-y), core::Vec3((x + y).normalized()),
                                   core::Vec3((x - y).normalized()), core::Vec3(-(x + y).normalized()),
                                   core::Vec3((y - x).normalized())})
      cut(side, side.dot(a.centre) + a.radius);
    choose(-normal, -normal.dot(a.centre) + a.half, least.depth(), found);
    if (found.count > 0) return;
  }
  // A line or a point of the cylinder, and the nearest edge or corner of b.
  const double depth = -least.gap();
  if (std::abs(a.axis.dot(normal)) < lies) {
    const core::Vec3 half = a.half * a.axis, foot = a.centre - a.radius * normal;
    double nearest = model::infinity;
    NearestPoints near{foot, foot};
    for (const model::Hull::Edge& edge : b.edges()) {
      const core::Vec3& from = b.vertex(edge.vertices[0]);
      const NearestPoints one =
          nearest_of_segments(foot - half, 2 * half, from, b.vertex(edge.vertices[1]) - from);
      const core::Vec3 apart = one.first - one.second;
      const double rated = (apart - normal.dot(apart) * normal).squaredNorm();
      if (!(rated < nearest)) continue;
      nearest = rated;
      near = one;
    }
    add_between(near.first, near.first + depth * normal, depth, found);
    return;
  }
  const double along = a.axis.dot(normal);
  const core::Vec3 aside = normal - along * a.axis;
  const double length = std::max(aside.norm(), 1e-9);
  const core::Vec3 on_rim = a.centre - (along > 0 ? a.half : -a.half) * a.axis - a.radius / length * aside;
  add_between(on_rim, on_rim + depth * normal, depth, found);
}

}  // namespace pbmpi::geometry
