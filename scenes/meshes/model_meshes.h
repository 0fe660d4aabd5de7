/// Meshes that model files name.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "scenes/meshes/hulls.h"
#include "scenes/meshes/mesh_text.h"

namespace pbmpi::scenes {

/// How a model places and scales a mesh before its geoms do.
struct MeshPlacing {
  core::Vec3 scale = core::Vec3::Ones();  ///< may mirror
  core::Pose frame;                       ///< of the mesh, in the file's coordinates
  int most_vertices = geometry::usual_hull_vertices;
};

/// A mesh as a model uses it: its convex hull, and what its own surface encloses.
struct ModelMesh {
  geometry::FoundHull found;
  std::optional<Enclosed> enclosed;  ///< none if the surface is not closed
  std::string note;                  ///< on what the hull leaves out; may be empty
};

/// `where`: "file:line:column: what", for messages. Throws core::InputError.
ModelMesh place_mesh(MeshPoints points, const MeshPlacing& placing, const std::string& where);

/// Mass properties in the mesh's frame, for a mass or else for a density: of what its surface encloses, or of
/// the hull if that is not closed.
MassProperties mass_of(const ModelMesh& mesh, std::optional<double> mass_kg, double density);

/// Stands in place of the text of a mesh that could not be read, until it is used.
std::string text_of_unreadable(const std::string& problem);

/// The text of a mesh by its name in the texts. Throws core::InputError "`where`: ..." if there is none, or
/// if it could not be read.
const std::string& text_of_mesh(const std::map<std::string, std::string>& texts, const std::string& name,
                                const std::string& where);

}  // namespace pbmpi::scenes
