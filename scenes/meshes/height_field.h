/// Surfaces over a grid of heights.
#pragma once

#include <vector>

#include "scenes/meshes/mesh_file.h"

namespace pbmpi::scenes {

/// Two triangles for each cell of the grid. `heights` [rows][columns] in m, at least 2 of each: the first row
/// at -y, the first column at -x; `x_m`, `y_m`: the sides of the grid, whose middle is at the origin.
Mesh mesh_of_heights(const std::vector<std::vector<double>>& heights, double x_m, double y_m);

}  // namespace pbmpi::scenes
