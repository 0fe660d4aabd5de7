// The scenes by name, and scene files by path.
#include <toml++/toml.h>
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <sstream>

#include "core/error.h"
#include "core/system/input_file.h"
#include "core/text.h"
#include "scenes/actors/model_file.h"
#include "scenes/embedded.h"
#include "scenes/meshes/model_meshes.h"
#include "scenes/scene.h"
#include "scenes/scene_toml.h"

namespace pbmpi::scenes {
namespace {

namespace fs = std::filesystem;

/// Where a mesh `package://name/path` of a model in this folder lies: in a folder of the package's name
/// around or in that of the model, or in one of those that ROS_PACKAGE_PATH lists. Empty without one.
fs::path in_package(const std::string& name, const fs::path& folder) {
  constexpr std::string_view scheme = "package://";
  const fs::path inside = fs::path(name.substr(scheme.size())).relative_path().lexically_normal();
  if (inside.empty() || *inside.begin() == "..") return {};
  std::vector<fs::path> roots;
  for (fs::path up = fs::absolute(folder); up != up.root_path(); up = up.parent_path()) roots.push_back(up);
  if (const char* listed = std::getenv("ROS_PACKAGE_PATH")) {
    std::istringstream paths(listed);
    for (std::string one; std::getline(paths, one, ':');) roots.emplace_back(one);
  }
  for (const fs::path& root : roots) {
    if (fs::is_regular_file(root / inside)) return root / inside;
  }
  return {};
}

/// The text of the mesh at `path` that `model` calls `name`, of its hull or of all triangles. What is wrong
/// with it matters only if it is used: a model may have meshes that are only drawn.
std::string read_mesh_of(const std::string& path, const std::string& model, const std::string& name,
                         bool as_surface = false) {
  try {
    const auto package = name.find("package://");
    const fs::path inside = package == std::string::npos
                                ? fs::path(path)
                                : in_package(name.substr(package), fs::path(model).parent_path());
    core::require_input(!inside.empty(), core::in_quotes(name) + " is in no folder around " + model +
                                             "; give that of its package in ROS_PACKAGE_PATH");
    const std::string bytes = core::read_input_file(inside.string(), model + " names it: give an STL or OBJ");
    const Mesh mesh = read_mesh(bytes, inside.string());
    return as_surface ? surface_text(mesh) : mesh_text(mesh, inside.string());
  } catch (const core::InputError& error) {
    return text_of_unreadable(error.what());
  }
}

/// The model's own text, or a scene of it and of what it includes. Included files are named from the model's
/// folder, which `source.file` begins with.
SceneSource read_model_scene(SceneSource source) {
  xml::Texts texts{{source.file, source.text}};
  for (auto missing = missing_files(texts, source.file); !missing.empty();
       missing = missing_files(texts, source.file)) {
    for (const std::string& file : missing)
      texts[file] = is_mesh_file(file)
                        ? read_mesh_of(file, source.file, file)
                        : core::read_input_file(file, source.file + " includes it: give the path of an MJCF");
  }
  if (texts.size() > 1) source.text = scene_with_includes(source, texts);
  return source;
}

SceneSource read_file(const std::string& path) {
  const std::filesystem::path at(path);
  SceneSource source{at.stem().string(), path,
                     core::read_input_file(path, "give the path of a scene file (TOML, MJCF or URDF)")};
  if (xml::is_xml(source.text)) return read_model_scene(std::move(source));
  const std::set<std::string> surfaces = surface_files(source);
  for (auto missing = missing_files(source); !missing.empty(); missing = missing_files(source)) {
    for (const std::string& file : missing) {
      const std::string found = (at.parent_path() / file).string();
      source.text = with_file(
          source.text, file,
          is_mesh_file(file) ? read_mesh_of(found, path, file, surfaces.contains(file))
                             : core::read_input_file(
                                   found, path + " names it: give the path of a model file (MJCF or URDF)"));
    }
  }
  return source;
}

/// The folder of a group whose names are many, and that are suggested only for names of that group; empty:
/// none.
std::string_view folder_of(std::string_view name) {
  for (const std::string_view folder : {"hard/", "exact/"})
    if (name.starts_with(folder)) return folder;
  return "";
}

}  // namespace

std::vector<SceneInfo> list_scenes(SceneGroup group) {
  std::vector<SceneInfo> list;
  for (const EmbeddedScene& scene : embedded_scenes()) {
    if (scene.group != group) continue;
    const toml::table table = toml::parse(scene.text);
    list.push_back({std::string(scene.name), table["title"].value_or(std::string())});
  }
  return list;
}

SceneSource find_scene(const std::string& name_or_path) {
  if (name_or_path.ends_with(".toml") || is_model_file(name_or_path)) return read_file(name_or_path);
  std::vector<std::string> names;
  for (const EmbeddedScene& scene : embedded_scenes()) {
    if (scene.name == name_or_path) {
      return {name_or_path, name_or_path + ".toml", std::string(scene.text)};
    }
    if (folder_of(scene.name) == folder_of(name_or_path)) names.emplace_back(scene.name);
  }
  // Naming all of a folder would make the list too long.
  const bool none_is_near =
      !folder_of(name_or_path).empty() && core::nearest_name(name_or_path, names).empty();
  throw core::InputError("unknown scene " + core::in_quotes(name_or_path) +
                         (none_is_near ? "" : core::suggestion(name_or_path, names)) +
                         " (--list-scenes shows all; a scene file of your own ends in .toml, .xml or .urdf)");
}

}  // namespace pbmpi::scenes
