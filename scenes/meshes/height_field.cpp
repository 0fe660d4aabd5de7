#include "scenes/meshes/height_field.h"

namespace pbmpi::scenes {

Mesh mesh_of_heights(const std::vector<std::vector<double>>& heights, double x_m, double y_m) {
  const int rows = static_cast<int>(heights.size()), columns = static_cast<int>(heights.front().size());
  Mesh mesh;
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column)
      mesh.points.emplace_back(x_m * (static_cast<double>(column) / (columns - 1) - 0.5),
                               y_m * (static_cast<double>(row) / (rows - 1) - 0.5),
                               heights[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)]);
  }
  for (int row = 0; row + 1 < rows; ++row) {
    for (int column = 0; column + 1 < columns; ++column) {
      const int at = row * columns + column, above = at + columns;
      mesh.triangles.push_back({at, at + 1, above});
      mesh.triangles.push_back({at + 1, above + 1, above});
    }
  }
  return mesh;
}

}  // namespace pbmpi::scenes
