#include "geometry/hulls/polyhedron.h"

#include <algorithm>

#include "geometry/geometry.h"
#include "geometry/hulls/convex_hull.h"

namespace pbmpi::geometry {
namespace {

/// A cube of sides 2.
const model::Hull& cube() {
  static const FoundHull found = [] {
    std::vector<core::Vec3> corners;
    corners.reserve(8);
    for (int i = 0; i < 8; ++i)
      corners.emplace_back((i & 1) != 0 ? 1 : -1, (i & 2) != 0 ? 1 : -1, (i & 4) != 0 ? 1 : -1);
    return convex_hull(corners, 8, "cube");
  }();
  return *found.hull;
}

/// Corners, faces and edges of a triangle.
const model::Hull& triangle_shape() {
  static const model::Hull shape = [] {
    model::Hull one;
    one.corners = {0, 1, 2};
    one.faces.resize(4);
    one.faces[0].count = 3;
    for (int k = 0; k < 3; ++k) one.edges.push_back({{k, (k + 1) % 3}, {0, k + 1}});
    return one;
  }();
  return shape;
}

using RowMajor = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

}  // namespace

void Polyhedron::place(const model::Geom& geom, const model::BodyPose& pose, const core::Vec3& origin) {
  const core::Mat3 axes = Eigen::Map<const RowMajor>(pose.rotation);
  const bool is_hull = geom.shape == model::Shape::hull;
  shape_ = is_hull ? geom.hull.get() : &cube();
  is_endless_ = false;
  const core::Vec3 scale =
      is_hull ? core::Vec3(1, 1, 1) : core::Vec3(geom.size[0] / 2, geom.size[1] / 2, geom.size[2] / 2);
  centre_ = core::Vec3(pose.position) - origin;
  vertices_.clear();
  normals_.clear();
  heights_.clear();
  inner_radius_ = model::infinity;
  for (const core::Vec3& vertex : shape_->vertices)
    vertices_.push_back(centre_ + axes * vertex.cwiseProduct(scale));
  for (const model::Hull::Face& face : shape_->faces) {
    normals_.push_back(axes * face.normal);
    const double above_centre = is_hull ? face.height : face.normal.cwiseAbs().dot(scale);
    heights_.push_back(normals_.back().dot(centre_) + above_centre);
    inner_radius_ = std::min(inner_radius_, above_centre);
  }
}

void Polyhedron::place_triangle(const TriangleMesh& mesh, int triangle, const model::BodyPose& pose,
                                const core::Vec3& origin) {
  const core::Mat3 axes = Eigen::Map<const RowMajor>(pose.rotation);
  const core::Vec3 from_origin = core::Vec3(pose.position) - origin;
  const TriangleMesh::Edges& edges = mesh.edges[static_cast<std::size_t>(triangle)];
  shape_ = &triangle_shape();
  is_endless_ = true;
  inner_radius_ = 0;
  vertices_.clear();
  for (int k = 0; k < 3; ++k) vertices_.push_back(from_origin + axes * mesh.corner(triangle, k));
  centre_ = (vertices_[0] + vertices_[1] + vertices_[2]) / 3;
  normals_ = {axes * mesh.surface.faces[static_cast<std::size_t>(triangle)].normal};
  for (const core::Vec3& side : edges.sides) normals_.push_back(axes * side);
  heights_ = {normals_[0].dot(vertices_[0])};
  for (std::size_t k = 0; k < 3; ++k) heights_.push_back(normals_[k + 1].dot(vertices_[k]));
}

Farthest Polyhedron::farthest(const core::Vec3& direction) const {
  Farthest best{0, direction.dot(vertices_[0])};
  for (std::size_t i = 1; i < vertices_.size(); ++i) {
    const double height = direction.dot(vertices_[i]);
    if (height > best.height) best = {static_cast<int>(i), height};
  }
  constexpr double level = 1e-9;  // rounding of directions
  if (is_endless_ && direction.dot(normals_[0]) < -level) best.height = model::infinity;
  return best;
}

int Polyhedron::face_towards(const core::Vec3& direction) const {
  int best = 0;
  double most = direction.dot(normals_[0]);
  for (int i = 1; i < num_faces() && num_corners(i) > 0; ++i) {
    const double cosine = direction.dot(normal(i));
    if (!(cosine > most)) continue;
    most = cosine;
    best = i;
  }
  return best;
}

}  // namespace pbmpi::geometry
