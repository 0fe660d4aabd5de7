#include "geometry/hulls/hull_axes.h"

#include <array>
#include <cmath>

namespace pbmpi::geometry {
namespace {

using Kind = LeastOverlap::Kind;

/// Edges that are nearly parallel add no axis to those of the faces, only rounding noise.
constexpr double least_sine2 = 1e-8;

/// How far the core's solid reaches along a unit direction from its centre [m].
double reach_of_cylinder(const Core& core, const core::Vec3& direction) {
  const double along = core.axis.dot(direction);
  return std::abs(along) * core.half + core.radius * std::sqrt(std::max(0.0, 1 - along * along));
}

/// The point of a cylinder that is farthest in a direction.
core::Vec3 farthest_of_cylinder(const Core& core, const core::Vec3& direction) {
  const double along = core.axis.dot(direction);
  const core::Vec3 aside = direction - along * core.axis;
  const double length = aside.norm();
  return core.centre + (along < 0 ? -core.half : core.half) * core.axis +
         (length > 1e-9 ? core::Vec3(core.radius / length * aside) : core::Vec3(core::Vec3::Zero()));
}

/// The gap between a cylinder and a polyhedron along a normal into the cylinder.
double gap_of_cylinder(const Core& a, const Polyhedron& b, const core::Vec3& normal) {
  return normal.dot(a.centre) - reach_of_cylinder(a, normal) - b.farthest(normal).height;
}

}  // namespace

/// The two faces at an edge bound the gap along any normal between theirs: that gap is at most the mean, with
/// weights, of the gaps at both faces of the vertex that is nearest to one of them. So where this vertex
/// overlaps both faces by more than the solids do along the best axis so far, the edge is not where they
/// touch.
void HullAxes::find_open_edges(const Polyhedron& one, const std::vector<Nearest>& nearest, double gap,
                               std::vector<OpenEdge>& open) {
  open.clear();
  const double most = std::min(gap, 0.0);
  const auto rules_out = [&](int face, int other) {
    const Nearest& near = nearest[static_cast<std::size_t>(face)];
    return near.gap <= most && one.normal(other).dot(near.point) - one.height(other) <= most;
  };
  for (int i = 0; i < static_cast<int>(one.edges().size()); ++i) {
    const model::Hull::Edge& edge = one.edges()[static_cast<std::size_t>(i)];
    if (rules_out(edge.faces[0], edge.faces[1]) || rules_out(edge.faces[1], edge.faces[0])) continue;
    const core::Vec3& from = one.vertex(edge.vertices[0]);
    open.push_back(
        {i, from, one.vertex(edge.vertices[1]) - from, one.normal(edge.faces[0]), one.normal(edge.faces[1])});
  }
}

/// A face whose gap to the ball within the other solid is no wider than the widest gap so far cannot have a
/// wider one. The face with the widest gap to that ball comes first.
void HullAxes::try_faces(const Polyhedron& one, const Polyhedron& other, Kind kind,
                         std::vector<Nearest>& nearest, LeastOverlap& least) {
  nearest.clear();
  int first = 0;
  for (int face = 0; face < one.num_faces(); ++face) {
    nearest.push_back({other.centre(), one.normal(face).dot(other.centre()) - one.height(face)});
    if (nearest.back().gap > nearest[static_cast<std::size_t>(first)].gap) first = face;
  }
  const auto try_face = [&](int face) {
    const core::Vec3& normal = one.normal(face);
    const Farthest found = other.farthest(-normal);
    const double gap = -found.height - one.height(face);
    const core::Vec3& point = other.vertex(found.vertex);
    nearest[static_cast<std::size_t>(face)] = {point, normal.dot(point) - one.height(face)};
    least.add_face(kind, gap, kind == Kind::face_of_a ? core::Vec3(-normal) : normal, face);
  };
  try_face(first);
  for (int face = 0; face < one.num_faces() && !least.apart(); ++face) {
    const double widest = nearest[static_cast<std::size_t>(face)].gap - other.inner_radius();
    if (face != first && widest > least.gap()) try_face(face);
  }
}

void HullAxes::separate(const Polyhedron& a, const Polyhedron& b, LeastOverlap& least) {
  try_faces(a, b, Kind::face_of_a, nearest_a_, least);
  if (least.apart()) return;
  try_faces(b, a, Kind::face_of_b, nearest_b_, least);
  if (least.apart()) return;
  find_open_edges(a, nearest_a_, least.gap(), open_a_);
  find_open_edges(b, nearest_b_, least.gap(), open_b_);
  for (const OpenEdge& one : open_a_) {
    for (const OpenEdge& other : open_b_) {
      // Do the arcs between one's normals and the opposites of the other's cross?
      const double first = -other.first_normal.dot(one.along), second = -other.second_normal.dot(one.along);
      const double third = one.first_normal.dot(other.along), fourth = one.second_normal.dot(other.along);
      if (!(first * second < 0 && third * fourth < 0)) continue;
      core::Vec3 normal = one.along.cross(other.along);
      const double square = normal.squaredNorm();
      if (!(square > least_sine2 * one.along.squaredNorm() * other.along.squaredNorm())) continue;
      normal /= std::sqrt(square);
      const core::Vec3 outward = one.first_normal + one.second_normal;
      if (outward.dot(normal) > 0) normal = -normal;  // into a
      const core::Vec3 outward_b = other.first_normal + other.second_normal;
      if (!(outward_b.dot(normal) > 0)) continue;  // the arcs cross on the other side of the sphere
      least.add_edges(normal.dot(one.from - other.from), normal, one.edge, other.edge);
    }
  }
}

void HullAxes::separate_capsule(const Core& a, const Polyhedron& b, LeastOverlap& least) {
  for (int face = 0; face < b.num_faces(); ++face) {
    const core::Vec3& normal = b.normal(face);
    const double reach = std::abs(normal.dot(a.axis)) * a.half + a.radius;
    least.add_face(Kind::face_of_b, normal.dot(a.centre) - reach - b.height(face), normal, face);
  }
  if (least.apart() || a.half == 0) return;
  for (int i = 0; i < static_cast<int>(b.edges().size()); ++i) {
    const model::Hull::Edge& edge = b.edges()[static_cast<std::size_t>(i)];
    const core::Vec3 &first = b.normal(edge.faces[0]), &second = b.normal(edge.faces[1]);
    if (!(first.dot(a.axis) * second.dot(a.axis) < 0)) continue;
    const core::Vec3& from = b.vertex(edge.vertices[0]);
    const core::Vec3 along = b.vertex(edge.vertices[1]) - from;
    core::Vec3 normal = along.cross(a.axis);
    const double square = normal.squaredNorm();
    if (!(square > least_sine2 * along.squaredNorm())) continue;
    normal /= (normal.dot(first + second) > 0 ? 1 : -1) * std::sqrt(square);
    least.add_edges(normal.dot(a.centre - from) - a.radius, normal, 0, i);
  }
}

void HullAxes::separate_cylinder(const Core& a, const Polyhedron& b, LeastOverlap& least) {
  nearest_b_.clear();
  for (int face = 0; face < b.num_faces(); ++face) {
    const core::Vec3& normal = b.normal(face);
    const core::Vec3 point = farthest_of_cylinder(a, -normal);
    nearest_b_.push_back({point, normal.dot(point) - b.height(face)});
    least.add_face(Kind::face_of_b, nearest_b_.back().gap, normal, face);
    if (least.apart()) return;
  }
  for (const double sign : {1.0, -1.0}) {
    const core::Vec3 normal = sign * a.axis;
    least.add_face(Kind::face_of_a, gap_of_cylinder(a, b, normal), normal, sign > 0 ? 0 : 1);
    if (least.apart()) return;
  }
  constexpr int num_tangents = 8;
  constexpr std::array<double, num_tangents> cosines = {
      1, 0.92387953251128674,  0.70710678118654752,  0.38268343236508977,
      0, -0.38268343236508977, -0.70710678118654752, -0.92387953251128674};
  const core::Vec3 x = a.axis.unitOrthogonal(), y = a.axis.cross(x);
  find_open_edges(b, nearest_b_, least.gap(), open_b_);
  for (const OpenEdge& edge : open_b_) {
    const auto try_line = [&](const core::Vec3& line) {
      core::Vec3 normal = edge.along.cross(line);
      const double square = normal.squaredNorm();
      if (!(square > least_sine2 * edge.along.squaredNorm())) return;
      normal /= (normal.dot(edge.first_normal + edge.second_normal) > 0 ? 1 : -1) * std::sqrt(square);
      least.add_edges(gap_of_cylinder(a, b, normal), normal, 0, edge.edge);
    };
    try_line(a.axis);
    for (std::size_t i = 0; i < num_tangents; ++i)
      try_line(cosines[i] * x + cosines[(i + 4) % num_tangents] * (i < 4 ? -1 : 1) * y);
    // The side against a corner.
    for (const core::Vec3& corner : {edge.from, core::Vec3(edge.from + edge.along)}) {
      const core::Vec3 from_axis = corner - a.centre - a.axis.dot(corner - a.centre) * a.axis;
      const double length = from_axis.norm();
      if (!(length > 1e-9)) continue;
      const core::Vec3 normal = -from_axis / length;
      least.add_edges(gap_of_cylinder(a, b, normal), normal, 0, edge.edge);
    }
  }
}

}  // namespace pbmpi::geometry
