#include "scenes/format/shape_reader.h"

#include <filesystem>
#include <string_view>
#include <vector>

#include "model/shape_traits.h"
#include "scenes/meshes/model_meshes.h"

namespace pbmpi::scenes {

const std::vector<model::Shape>& solid_shapes() {
  static const std::vector<model::Shape> shapes = [] {
    std::vector<model::Shape> solid;
    for (const model::ShapeTraits& traits : model::shape_traits) {
      if (traits.num_sizes > 0) solid.push_back(traits.shape);
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

MeshPoints read_points(TableReader& table, const MeshSource& meshes) {
  if (table.has("points") == table.has("file"))
    table.fail("file", "give either 'points' [[x, y, z], ...] or a 'file', an STL or OBJ");
  if (table.has("points")) return {table.vectors("points", Sign::any), std::nullopt, 0};
  const std::string file = table.text("file");
  const std::filesystem::path path = std::filesystem::path(file).lexically_normal();
  if (path.empty() || path.is_absolute() || *path.begin() == "..")
    table.fail("file", "a mesh lies in the folder of the scene's file or below it; move it there");
  const std::map<std::string, std::string> none;
  return read_mesh_text(
      text_of_mesh(meshes.files == nullptr ? none : *meshes.files, file, table.where("file")), file);
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

}  // namespace pbmpi::scenes
