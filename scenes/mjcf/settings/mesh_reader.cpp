#include "scenes/mjcf/settings/mesh_reader.h"

#include <algorithm>
#include <filesystem>
#include <set>
#include <string_view>

#include "core/error.h"
#include "core/text.h"
#include "scenes/meshes/height_field.h"

namespace pbmpi::scenes::mjcf {
namespace {

namespace fs = std::filesystem;
using xml::Attributes;

/// Where `<compiler>` lets meshes be looked for.
struct MeshFolder {
  std::string folder;  ///< from that of the model
  bool strips_path = false;
};

MeshFolder folder_in(const xml::Element& root) {
  MeshFolder found;
  for (const xml::Element& one : root.children) {
    if (one.name != "compiler") continue;
    for (const char* name : {"assetdir", "meshdir"}) {
      if (const xml::Attribute* given = one.find(name)) found.folder = given->value;
    }
    if (const xml::Attribute* strips = one.find("strippath")) found.strips_path = strips->value == "true";
  }
  return found;
}

/// The name in the texts; empty for a file outside of the model's folder.
std::string name_in_texts(const std::string& given, const MeshFolder& folder, const std::string& model) {
  const fs::path file = folder.strips_path ? fs::path(given).filename() : fs::path(given);
  const fs::path name = (fs::path(folder.folder) / file).lexically_normal();
  if (name.empty() || name.is_absolute() || *name.begin() == "..") return "";
  return (fs::path(model).parent_path() / name).string();
}

template <class Found>
void for_each_asset(const xml::Element& root, std::string_view kind, const Found& found) {
  for (const xml::Element& assets : root.children) {
    if (assets.name != "asset") continue;
    for (const xml::Element& one : assets.children) {
      if (one.name == kind) found(one);
    }
  }
}

std::vector<core::Vec3> read_vertices(Attributes& mesh) {
  constexpr std::size_t most = 3 * most_triangles;
  const std::vector<double> numbers = mesh.numbers("vertex", 3, most);
  if (numbers.size() % 3 != 0) mesh.fail("vertex", "'vertex' needs three numbers for each point");
  std::vector<core::Vec3> points;
  for (std::size_t i = 0; i < numbers.size(); i += 3) points.emplace_back(numbers.data() + i);
  return points;
}

}  // namespace

std::vector<std::string> mesh_files(const std::string& file, const xml::Texts& texts) {
  xml::Element root = xml::parse(texts.at(file), file);
  xml::Notes told_later;
  xml::expand_includes(root, file, texts, xml::LeaveOut({}, told_later));
  const MeshFolder folder = folder_in(root);
  std::set<std::string> files;
  for_each_asset(root, "mesh", [&](const xml::Element& mesh) {
    const xml::Attribute* given = mesh.find("file");
    if (given != nullptr && is_mesh_file(given->value))
      files.insert(name_in_texts(given->value, folder, file));
  });
  files.erase("");
  return {files.begin(), files.end()};
}

Meshes::Meshes(const xml::Element& root, const std::string& file, const xml::Texts& texts,
               const Defaults& defaults, xml::Notes& notes)
    : file_(file), texts_(texts), defaults_(defaults), notes_(notes) {
  const MeshFolder folder = folder_in(root);
  folder_ = folder.folder;
  strips_path_ = folder.strips_path;
  const auto index = [&](const char* kind, Elements& elements) {
    for_each_asset(root, kind, [&](const xml::Element& asset) {
      const xml::Attribute *name = asset.find("name"), *given = asset.find("file");
      if (name != nullptr || given != nullptr)
        elements.emplace(name != nullptr ? name->value : fs::path(given->value).stem().string(), &asset);
    });
  };
  index("mesh", elements_);
  index("hfield", field_elements_);
}

const xml::Element& Meshes::find(Attributes& geom, const char* kind, const Elements& elements) {
  const std::string name = geom.text(kind);
  const auto element = elements.find(name);
  if (element == elements.end()) {
    std::vector<std::string> names;
    for (const auto& [one, is] : elements) names.push_back(one);
    geom.fail(kind, "no <" + std::string(kind) + "> of <asset> is called " + core::in_quotes(name) +
                        (names.empty() ? "; give one there" : core::suggestion(name, names)));
  }
  return *element->second;
}

const ModelMesh& Meshes::of(Attributes& geom) {
  const std::string name = geom.text("mesh");
  const auto known = read_.find(name);
  if (known != read_.end()) return known->second;
  return read(name, find(geom, "mesh", elements_));
}

/// The first row of `elevation` lies at +y. MuJoCo takes the lowest height as 0 and the highest as 1; without
/// `elevation` all are 0.
const geometry::PlacedMesh& Meshes::height_field_of(Attributes& geom) {
  const xml::Element& element = find(geom, "hfield", field_elements_);
  const std::string name = geom.text("hfield");
  if (const auto known = fields_.find(name); known != fields_.end()) return known->second;
  Attributes field(element, defaults_.of(element, ""));
  if (field.has("file"))
    field.fail_unless_left_out(
        "file", "height fields are not read from files; give 'nrow', 'ncol', 'elevation'", "hfield");
  const auto rows = static_cast<std::size_t>(field.integer("nrow", 2, 0)),
             columns = static_cast<std::size_t>(field.integer("ncol", 2, 0));
  const std::vector<double> size = field.numbers("size", 4, 4);
  if (size.empty() || !(*std::ranges::min_element(size) > 0))
    field.fail("'size' needs four numbers above 0: half the sides, the height, the depth of the base [m]");
  constexpr std::size_t most = geometry::most_mesh_triangles;
  if (rows > most || columns > most || rows * columns > most)
    field.fail("nrow", "a height field has at most " + std::to_string(most) + " points");
  std::vector<double> given = field.numbers("elevation", 1, most);
  if (given.empty()) given.assign(rows * columns, 0);
  if (given.size() != rows * columns)
    field.fail("elevation", "'elevation' needs nrow x ncol numbers, " + std::to_string(rows * columns));
  field.allow({"name"});
  field.finish();
  const auto [low, high] = std::ranges::minmax(given);
  std::vector<std::vector<double>> heights(rows);
  for (std::size_t row = 0; row < rows; ++row) {
    for (std::size_t column = 0; column < columns; ++column) {
      const double above = given[(rows - 1 - row) * columns + column] - low;
      heights[row].push_back(size[2] * (high > low ? above / (high - low) : above));
    }
  }
  const Mesh mesh = mesh_of_heights(heights, 2 * size[0], 2 * size[1]);
  return fields_.emplace(name, geometry::triangle_mesh(mesh.points, mesh.triangles, element.where))
      .first->second;
}

const ModelMesh& Meshes::read(const std::string& name, const xml::Element& element) {
  Attributes mesh(element, defaults_.of(element, ""));
  MeshPlacing placing;
  placing.scale = mesh.vector("scale", core::Vec3(core::Vec3::Ones()));
  if (!(placing.scale.cwiseAbs().minCoeff() > 0)) mesh.fail("scale", "'scale' must not be 0");
  placing.frame.position = mesh.vector("refpos", core::Vec3(core::Vec3::Zero()));
  if (mesh.has("refquat")) placing.frame.orientation = mesh.turn("refquat");
  placing.most_vertices =
      std::min(mesh.integer("maxhullvert", geometry::least_hull_vertices, placing.most_vertices),
               geometry::most_hull_vertices);
  const std::string inertia = mesh.word("inertia", {"legacy", "exact", "convex", "shell"}, "legacy");
  if (inertia == "shell")
    mesh.fail_unless_left_out("inertia", "hollow meshes are not read; give the body an <inertial>");
  mesh.allow({"name", "class", "smoothnormal", "normal", "texcoord", "face", "content_type", "material",
              "octree_maxdepth"});
  MeshPoints points;
  const bool has_file = mesh.has("file");
  if (has_file) {
    const std::string given = mesh.text("file");
    if (!is_mesh_file(given))
      mesh.fail_unless_left_out("file", "this mesh is no STL or OBJ; convert it to one of them", "mesh");
    const std::string file = name_in_texts(given, {folder_, strips_path_}, file_);
    if (file.empty())
      mesh.fail("file",
                "a mesh lies in the folder of " + core::in_quotes(file_) + " or below it; move it there");
    points = read_mesh_text(text_of_mesh(texts_, file, mesh.where("file")), file);
  } else {
    points.points = read_vertices(mesh);
  }
  mesh.finish();
  if (inertia == "convex") points.enclosed.reset();
  ModelMesh placed =
      place_mesh(std::move(points), placing, element.where + ": mesh " + core::in_quotes(name));
  if (!placed.note.empty()) notes_.add(element.where, "mesh " + core::in_quotes(name) + ": " + placed.note);
  if (has_file && !placed.enclosed && inertia != "convex")
    notes_.add(element.where, "the surface of mesh " + core::in_quotes(name) +
                                  " is not closed: where its mass counts, it is that of its hull");
  return read_.emplace(name, std::move(placed)).first->second;
}

}  // namespace pbmpi::scenes::mjcf
