/// Shapes and their sizes in scene files.
#pragma once

#include <array>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "geometry/triangle_mesh.h"
#include "model/model.h"
#include "scenes/format/table_reader.h"
#include "scenes/parts/mass_properties.h"

namespace pbmpi::scenes {

/// The shapes that enclose a volume, and their names.
const std::vector<model::Shape>& solid_shapes();

/// Reads `shape = "box"`, one of `allowed`.
model::Shape read_shape(TableReader& table, std::span<const model::Shape> allowed);

/// Reads the keys `size`, `radius` and `length` that a solid shape has, all above 0, as Geom::size [m].
std::array<double, 3> read_size(TableReader& table, model::Shape shape);

/// The texts of meshes that a scene names, and what is to be said of them.
struct MeshSource {
  const std::map<std::string, std::string>* files = nullptr;
  std::vector<std::string>* notes = nullptr;
};

/// Reads the keys of a solid shape: for a hull `points` or `file`, `scale` and `vertices`, else its sizes.
Solid read_solid_shape(TableReader& table, model::Shape shape, const MeshSource& meshes);

/// Reads the keys of a mesh: `points` and `triangles`, or `file`; `scale`. Its centre is in the actor's
/// frame.
geometry::PlacedMesh read_mesh_shape(TableReader& table, const MeshSource& meshes);

/// Reads the keys of a height field, `heights` and `size`, whose middle is the origin.
geometry::PlacedMesh read_height_field(TableReader& table);

}  // namespace pbmpi::scenes
