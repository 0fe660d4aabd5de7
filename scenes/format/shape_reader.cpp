#include "scenes/format/shape_reader.h"

#include <filesystem>
#include <string_view>
#include <vector>

#include "core/text.h"
#include "model/shape_traits.h"
#include "scenes/meshes/height_field.h"
#include "scenes/meshes/model_meshes.h"

namespace pbmpi::scenes {

const std::vector<model::Shape>& solid_shapes() {
  static const std::vector<model::Shape> shapes = [] {
    std::vector<model::Shape> solid;
    for (const model::ShapeTraits& traits : model::shape_traits) {
      if (traits.num_sizes > 0 && traits.shape != model::Shape::mesh) solid.push_back(traits.shape);
    }
    return solid;
  }();
  return shapes;
}

model::Shape read_shape(TableReader& table, std::span<const model::Shape> allowed) {
  std::vector<std::string_view> names;
  for (const model::Shape shape : allowed) names.push_back(model::traits_of(shape).name);
  return allowed[table.choice("shape", names)];
}

std::array<double, 3> read_size(TableReader& table, model::Shape shape) {
  const model::ShapeTraits& traits = model::traits_of(shape);
  std::array<double, 3> size{};
  if (traits.radius == model::no_size) {
    const core::Vec3 sides = table.vector("size", Sign::positive);
    return {sides.x(), sides.y(), sides.z()};
  }
  size[static_cast<std::size_t>(traits.radius)] = table.number("radius", Sign::positive);
  if (traits.length[2] != model::no_size)
    size[static_cast<std::size_t>(traits.length[2])] = table.number("length", Sign::positive);
  return size;
}

namespace {

void require_points_or_file(TableReader& table) {
  if (table.has("points") == table.has("file"))
    table.fail("file", "give either 'points' [[x, y, z], ...] or a 'file', an STL or OBJ");
}

/// The text of the mesh that the table names as its `file`.
const std::string& read_text(TableReader& table, const MeshSource& meshes) {
  const std::string file = table.text("file");
  const std::filesystem::path path = std::filesystem::path(file).lexically_normal();
  if (path.empty() || path.is_absolute() || *path.begin() == "..")
    table.fail("file", "a mesh lies in the folder of the scene's file or below it; move it there");
  static const std::map<std::string, std::string> none;
  return text_of_mesh(meshes.files == nullptr ? none : *meshes.files, file, table.where("file"));
}

MeshPoints read_points(TableReader& table, const MeshSource& meshes) {
  require_points_or_file(table);
  if (table.has("points")) return {table.vectors("points", Sign::any), std::nullopt, 0};
  const std::string& text = read_text(table, meshes);
  return read_mesh_text(text, table.text("file"));
}

/// Reads `triangles` [[a, b, c], ...], indices of points from 0.
std::vector<std::array<int, 3>> read_triangles(TableReader& table, std::size_t num_points) {
  std::vector<std::array<int, 3>> triangles;
  for (const core::Vec3& corners : table.vectors("triangles", Sign::non_negative)) {
    std::array<int, 3> triangle{};
    for (int k = 0; k < 3; ++k) {
      if (!(corners[k] < static_cast<double>(num_points)) || corners[k] != static_cast<int>(corners[k]))
        table.fail("triangles", "there is no point " + core::number_text(corners[k]) + "; the first of the " +
                                    std::to_string(num_points) + " points is 0");
      triangle[static_cast<std::size_t>(k)] = static_cast<int>(corners[k]);
    }
    triangles.push_back(triangle);
  }
  return triangles;
}

}  // namespace

Solid read_solid_shape(TableReader& table, model::Shape shape, const MeshSource& meshes) {
  if (!model::traits_of(shape).has_points) return {shape, read_size(table, shape), {}};
  MeshPoints read = read_points(table, meshes);
  const core::Vec3 scale = table.vector("scale", Sign::positive, core::Vec3(core::Vec3::Ones()));
  for (core::Vec3& point : read.points) point = point.cwiseProduct(scale);
  const int most = table.integer("vertices", geometry::least_hull_vertices, geometry::usual_hull_vertices);
  if (most > geometry::most_hull_vertices)
    table.fail("vertices",
               "a hull has at most " + std::to_string(geometry::most_hull_vertices) + " vertices");
  const geometry::FoundHull found =
      geometry::convex_hull(read.points, most, table.where() + ": " + table.what());
  const std::string note = note_on(found, read.left_out_m * scale.maxCoeff());
  if (!note.empty() && meshes.notes != nullptr)
    meshes.notes->push_back(table.where() + ": " + table.what() + ": " + note);
  return solid_of(found, {});
}

geometry::PlacedMesh read_mesh_shape(TableReader& table, const MeshSource& meshes) {
  require_points_or_file(table);
  Mesh mesh;
  if (table.has("points")) {
    mesh.points = table.vectors("points", Sign::any);
    mesh.triangles = read_triangles(table, mesh.points.size());
  } else {
    const std::string& text = read_text(table, meshes);
    mesh = read_surface_text(text, table.text("file"));
  }
  const core::Vec3 scale = table.vector("scale", Sign::positive, core::Vec3(core::Vec3::Ones()));
  for (core::Vec3& point : mesh.points) point = point.cwiseProduct(scale);
  return geometry::triangle_mesh(mesh.points, mesh.triangles, table.where() + ": " + table.what());
}

geometry::PlacedMesh read_height_field(TableReader& table) {
  const std::vector<std::vector<double>> heights = table.rows("heights");
  const auto [x, y] = table.pair("size");
  if (!(x > 0 && y > 0)) table.fail("size", "the sides of a height field, [x, y], must be above 0");
  if (heights.size() < 2 || heights.front().size() < 2)
    table.fail("heights", "a height field needs at least 2 rows of 2 heights");
  const Mesh mesh = mesh_of_heights(heights, x, y);
  return geometry::triangle_mesh(mesh.points, mesh.triangles, table.where() + ": " + table.what());
}

}  // namespace pbmpi::scenes
