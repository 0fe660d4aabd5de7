#include "scenes/mjcf/settings/mesh_reader.h"

#include <filesystem>
#include <set>

#include "core/error.h"
#include "core/text.h"

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
void for_each_mesh(const xml::Element& root, const Found& found) {
  for (const xml::Element& assets : root.children) {
    if (assets.name != "asset") continue;
    for (const xml::Element& one : assets.children) {
      if (one.name == "mesh") found(one);
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
  for_each_mesh(root, [&](const xml::Element& mesh) {
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
  for_each_mesh(root, [&](const xml::Element& mesh) {
    const xml::Attribute *name = mesh.find("name"), *given = mesh.find("file");
    if (name != nullptr || given != nullptr)
      elements_.emplace(name != nullptr ? name->value : fs::path(given->value).stem().string(), &mesh);
  });
}

const ModelMesh& Meshes::of(Attributes& geom) {
  const std::string name = geom.text("mesh");
  const auto known = read_.find(name);
  if (known != read_.end()) return known->second;
  const auto element = elements_.find(name);
  if (element == elements_.end()) {
    std::vector<std::string> names;
    for (const auto& [one, is] : elements_) names.push_back(one);
    geom.fail("mesh", "no <mesh> of <asset> is called " + core::in_quotes(name) +
                          (names.empty() ? "; give one there" : core::suggestion(name, names)));
  }
  return read(name, *element->second);
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
