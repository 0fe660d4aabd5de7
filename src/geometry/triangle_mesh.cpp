#include "geometry/triangle_mesh.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "core/error.h"

namespace pbmpi::geometry {
namespace {

using core::Vec3;

/// Sine of the angle up to which two triangles count as level with each other: rounding of coordinates.
constexpr double level = 1e-7;

Box box_of(const TriangleMesh& mesh, int triangle) {
  Box box;
  for (int k = 0; k < 3; ++k) {
    const Vec3& at = mesh.corner(triangle, k);
    const std::array<double, 3> corner = {at.x(), at.y(), at.z()};
    box.include({corner, corner});
  }
  return box;
}

/// Adds the triangle as a face, unless it has no area.
void add_face(const std::array<int, 3>& corners, model::Hull& surface) {
  const auto vertex = [&](std::size_t k) -> const Vec3& {
    return surface.vertices[static_cast<std::size_t>(corners[k])];
  };
  const Vec3 first = vertex(1) - vertex(0), second = vertex(2) - vertex(0), third = vertex(2) - vertex(1);
  const Vec3 normal = first.cross(second);
  const double area = normal.norm();
  const double longest = std::max({first.squaredNorm(), second.squaredNorm(), third.squaredNorm()});
  constexpr double least_height = 1e-9;  // over the longest side, as a share of that
  if (!(area > least_height * longest)) return;
  const Vec3 unit = normal / area;
  surface.faces.push_back({unit, unit.dot(vertex(0)), static_cast<int>(surface.corners.size()), 3});
  surface.corners.insert(surface.corners.end(), corners.begin(), corners.end());
  surface.surface += area / 2;
}

/// Which triangle has the edge from a to b; of several, the first.
using EdgeIndex = std::map<std::pair<int, int>, int>;

EdgeIndex index_edges(const model::Hull& surface) {
  EdgeIndex index;
  for (int at = 0; at < static_cast<int>(surface.corners.size()); ++at) {
    const int next = at % 3 == 2 ? at - 2 : at + 1;
    index.emplace(std::pair(surface.corners[static_cast<std::size_t>(at)],
                            surface.corners[static_cast<std::size_t>(next)]),
                  at / 3);
  }
  return index;
}

TriangleMesh::Edges edges_of(const TriangleMesh& mesh, int triangle, const EdgeIndex& index) {
  const model::Hull& surface = mesh.surface;
  const Vec3& normal = surface.faces[static_cast<std::size_t>(triangle)].normal;
  TriangleMesh::Edges edges;
  for (int k = 0; k < 3; ++k) {
    const int next = (k + 1) % 3;
    const Vec3 along = (mesh.corner(triangle, next) - mesh.corner(triangle, k)).normalized();
    const Vec3 outward = along.cross(normal);
    const auto corner = [&](int i) { return surface.corners[static_cast<std::size_t>(3 * triangle + i)]; };
    const auto neighbour = index.find({corner(next), corner(k)});
    const auto at = static_cast<std::size_t>(k);
    edges.sides[at] = outward;
    if (neighbour == index.end()) {  // an open end, over which a normal may lean up to the outward direction
      edges.beyond[at] = -normal;
      continue;
    }
    const Vec3& other = surface.faces[static_cast<std::size_t>(neighbour->second)].normal;
    const bool is_ridge = other.dot(outward) > level;
    edges.beyond[at] = is_ridge ? along.cross(other).normalized() : outward;
    if (is_ridge && other.dot(normal) > 0) edges.sides[at] = other;
  }
  return edges;
}

/// The share of the path at which it comes through the front of a triangle. An edge belongs to both of its
/// triangles, so that no path slips between them.
std::optional<double> share_at_hit(const TriangleMesh& mesh, int triangle, const Vec3& from,
                                   const Vec3& way) {
  const model::Hull::Face& face = mesh.surface.faces[static_cast<std::size_t>(triangle)];
  const double rate = face.normal.dot(way);
  if (!(rate < 0)) return std::nullopt;
  const double share = (face.height - face.normal.dot(from)) / rate;
  if (!(share >= 0 && share <= 1)) return std::nullopt;
  const Vec3 hit = from + share * way;
  constexpr double room = 1e-9;  // of the squared length of an edge, for rounding
  for (int k = 0; k < 3; ++k) {
    const Vec3& corner = mesh.corner(triangle, k);
    const Vec3 along = mesh.corner(triangle, (k + 1) % 3) - corner;
    if (along.cross(face.normal).dot(hit - corner) > room * along.squaredNorm()) return std::nullopt;
  }
  return share;
}

}  // namespace

std::optional<TriangleMesh::Hit> TriangleMesh::first_hit(const Vec3& from, const Vec3& way) const {
  std::optional<Hit> first;
  tree.for_each_near(swept_box(from, 0, way), [&](int triangle) {
    const auto share = share_at_hit(*this, triangle, from, way);
    if (!share) return;
    const bool is_nearer =
        !first || *share < first->share || (*share == first->share && triangle < first->triangle);
    if (is_nearer) first = Hit{*share, triangle};
  });
  return first;
}

PlacedMesh triangle_mesh(std::span<const Vec3> points, std::span<const std::array<int, 3>> triangles,
                         const std::string& where) {
  core::require_input(triangles.size() <= most_mesh_triangles,
                      where + ": " + std::to_string(triangles.size()) + " triangles are more than the " +
                          std::to_string(most_mesh_triangles) +
                          " that a mesh may have; reduce it, or cut it up");
  core::require_input(std::ranges::all_of(points, [](const Vec3& point) { return point.allFinite(); }),
                      where + ": a point is not finite; correct it");
  Vec3 low = Vec3::Constant(model::infinity), high = -low;
  for (const std::array<int, 3>& triangle : triangles) {
    for (const int corner : triangle) {
      low = low.cwiseMin(points[static_cast<std::size_t>(corner)]);
      high = high.cwiseMax(points[static_cast<std::size_t>(corner)]);
    }
  }
  auto mesh = std::make_shared<TriangleMesh>();
  const Vec3 centre = triangles.empty() ? Vec3(Vec3::Zero()) : Vec3(0.5 * low + 0.5 * high);
  for (const Vec3& point : points) mesh->surface.vertices.emplace_back(point - centre);
  for (const std::array<int, 3>& triangle : triangles) add_face(triangle, mesh->surface);
  core::require_input(!mesh->surface.faces.empty(),
                      where + ": there are no triangles that have an area; give some");
  const EdgeIndex index = index_edges(mesh->surface);
  std::vector<Box> boxes;
  for (int i = 0; i < static_cast<int>(mesh->surface.faces.size()); ++i) {
    mesh->edges.push_back(edges_of(*mesh, i, index));
    boxes.push_back(box_of(*mesh, i));
  }
  mesh->tree.set(boxes);
  return {std::move(mesh), centre};
}

/// A level mesh gets a box of some height, since sizes are above 0.
void put_mesh(const std::shared_ptr<const TriangleMesh>& mesh, model::Geom& geom) {
  Vec3 half = Vec3::Zero();
  for (const int corner : mesh->surface.corners)
    half = half.cwiseMax(mesh->surface.vertices[static_cast<std::size_t>(corner)].cwiseAbs());
  constexpr double least_share = 1e-3;  // of the largest side
  half = half.cwiseMax(least_share * half.maxCoeff());
  geom.shape = model::Shape::mesh;
  geom.size = {2 * half.x(), 2 * half.y(), 2 * half.z()};
  geom.mesh = mesh;
  geom.hull = std::shared_ptr<const model::Hull>(mesh, &mesh->surface);
}

}  // namespace pbmpi::geometry
