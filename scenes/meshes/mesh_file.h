/// Triangles from files of other programs: STL, binary or text, and OBJ.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "core/vector.h"

namespace pbmpi::scenes {

struct Mesh {
  std::vector<core::Vec3> points;             ///< [m], or in the file's own unit
  std::vector<std::array<int, 3>> triangles;  ///< counter-clockwise as seen from outside
};

inline constexpr std::size_t most_triangles = 1000000;

/// Does the path end like a mesh's, in ".stl" or ".obj"?
bool is_mesh_file(const std::string& path);

/// Points with equal coordinates become one. An OBJ may have points alone. `file`: the name in messages,
/// which also tells the format. Throws core::InputError for a file that is truncated or malformed, or has
/// more than most_triangles.
Mesh read_mesh(const std::string& bytes, const std::string& file);

}  // namespace pbmpi::scenes
