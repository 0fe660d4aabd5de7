/// Surfaces of triangles for the static environment: terrain, rooms.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "geometry/box_tree.h"

namespace pbmpi::geometry {

/// As many as a file of the run should carry, since each of them is in it.
inline constexpr int most_mesh_triangles = 200000;

/// The triangles, one face of the surface each, with their front where their corners are counter-clockwise.
struct TriangleMesh {
  /// Of a triangle, edge k from its corner k to the next.
  struct Edges {
    /// Where the surface goes on behind the edge: unit, square to the edge. A normal of a contact does not
    /// lean over the edge farther than square to it. At a level or a hollow edge, it does not lean over it at
    /// all.
    std::array<core::Vec3, 3> beyond;
    /// Unit normal of a plane through the edge below which the solid lies: that of the next triangle at a
    /// ridge, else square to the triangle.
    std::array<core::Vec3, 3> sides;
  };
  struct Hit {
    double share = 0;  ///< of the path
    int triangle = 0;
  };

  model::Hull surface;       ///< its faces in the order of the triangles
  std::vector<Edges> edges;  ///< [num_triangles]
  BoxTree tree;              ///< of the triangles

  const core::Vec3& corner(int triangle, int k) const {
    return surface
        .vertices[static_cast<std::size_t>(surface.corners[static_cast<std::size_t>(3 * triangle + k)])];
  }
  /// The first triangle through whose front the path comes from outside.
  std::optional<Hit> first_hit(const core::Vec3& from, const core::Vec3& way) const;
};

struct PlacedMesh {
  std::shared_ptr<const TriangleMesh> mesh;
  core::Vec3 centre = core::Vec3::Zero();  ///< the mesh's origin in the frame of the points [m]
};

/// A triangle of no area is left out. `where`: "file:line:column: what", for the core::InputError that is
/// thrown if no triangle is left, or more than most_mesh_triangles, or a point is not finite.
PlacedMesh triangle_mesh(std::span<const core::Vec3> points, std::span<const std::array<int, 3>> triangles,
                         const std::string& where);

/// The geom's shape, size and surface for a mesh.
void put_mesh(const std::shared_ptr<const TriangleMesh>& mesh, model::Geom& geom);

}  // namespace pbmpi::geometry
