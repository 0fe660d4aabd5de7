/// What a scene keeps of a mesh, as text: the points of its convex hull and its mass properties, or its
/// triangles.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/vector.h"
#include "scenes/meshes/mesh_file.h"

namespace pbmpi::scenes {

/// What a closed surface encloses, for a density of 1.
struct Enclosed {
  double volume = 0;                        ///< [m^3]
  core::Vec3 centre = core::Vec3::Zero();   ///< [m]
  core::Mat3 moments = core::Mat3::Zero();  ///< [m^5] integral of x x^T about the centre
};

struct MeshPoints {
  std::vector<core::Vec3> points;
  std::optional<Enclosed> enclosed;  ///< none if the surface is not closed
  double left_out_m = 0;             ///< how far points stick out of their hull that are not among these
};

/// An OBJ of the hull's points, with the rest in comments. It is much shorter than the mesh, and all ranks
/// and files of a run can carry it. Throws core::InputError for a mesh in one plane.
std::string mesh_text(const Mesh& mesh, const std::string& file);

/// An OBJ of the triangles themselves, for what needs the whole surface.
std::string surface_text(const Mesh& mesh);

/// Reads a text of either, or that of an OBJ.
Mesh read_surface_text(const std::string& text, const std::string& file);
MeshPoints read_mesh_text(const std::string& text, const std::string& file);

}  // namespace pbmpi::scenes
