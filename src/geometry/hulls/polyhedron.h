/// A hull, a box or a triangle of a mesh at a place in the world, for collision detection.
#pragma once

#include <vector>

#include "geometry/triangle_mesh.h"
#include "model/contact.h"

namespace pbmpi::geometry {

/// The farthest vertex in a direction.
struct Farthest {
  int vertex = 0;
  double height = 0;  ///< [m] along the direction, above the frame's origin
};

/// Vertices and faces of a hull in the world's axes, about an origin near the pair. Keeps its memory.
///
/// A triangle stands for the solid below it, which goes on without an end: it is face 0, and its other faces
/// are planes through its edges (TriangleMesh::Edges::sides), without corners.
class Polyhedron {
 public:
  /// `geom`: a hull or a box; `pose`: its own (geom_pose()); `origin` [m], world frame.
  void place(const model::Geom& geom, const model::BodyPose& pose, const core::Vec3& origin);
  /// A triangle of a mesh, whose pose it is.
  void place_triangle(const TriangleMesh& mesh, int triangle, const model::BodyPose& pose,
                      const core::Vec3& origin);

  const core::Vec3& centre() const { return centre_; }
  /// [m] Radius of the ball about its centre that it holds.
  double inner_radius() const { return inner_radius_; }
  const std::vector<core::Vec3>& vertices() const { return vertices_; }
  const core::Vec3& vertex(int i) const { return vertices_[static_cast<std::size_t>(i)]; }
  int num_faces() const { return static_cast<int>(normals_.size()); }
  const core::Vec3& normal(int face) const { return normals_[static_cast<std::size_t>(face)]; }
  /// [m] Height of a face's plane along its normal.
  double height(int face) const { return heights_[static_cast<std::size_t>(face)]; }
  int num_corners(int face) const { return shape_->faces[static_cast<std::size_t>(face)].count; }
  /// The i-th corner of a face, counter-clockwise as seen from outside.
  const core::Vec3& corner(int face, int i) const {
    const int at = shape_->faces[static_cast<std::size_t>(face)].first + i;
    return vertex(shape_->corners[static_cast<std::size_t>(at)]);
  }
  const std::vector<model::Hull::Edge>& edges() const { return shape_->edges; }

  /// Infinitely high where a solid has no end in that direction.
  Farthest farthest(const core::Vec3& direction) const;
  /// The face with corners whose normal is nearest to the direction.
  int face_towards(const core::Vec3& direction) const;

 private:
  const model::Hull* shape_ = nullptr;
  bool is_endless_ = false;  ///< against the normal of face 0
  core::Vec3 centre_;
  double inner_radius_ = 0;
  std::vector<core::Vec3> vertices_, normals_;
  std::vector<double> heights_;
};

}  // namespace pbmpi::geometry
