// The scenes by name, and scene files by path.
#include <toml++/toml.h>
#include <algorithm>
#include <filesystem>

#include "core/error.h"
#include "core/system/input_file.h"
#include "core/text.h"
#include "scenes/actors/model_file.h"
#include "scenes/embedded.h"
#include "scenes/scene.h"
#include "scenes/scene_toml.h"

namespace pbmpi::scenes {
namespace {

/// The model's own text, or a scene of it and of what it includes. Included files are named from the model's
/// folder, which `source.file` begins with.
SceneSource read_model_scene(SceneSource source) {
  xml::Texts texts{{source.file, source.text}};
  for (auto missing = missing_files(texts, source.file); !missing.empty();
       missing = missing_files(texts, source.file)) {
    for (const std::string& file : missing)
      texts[file] = core::read_input_file(file, source.file + " includes it: give the path of an MJCF");
  }
  if (texts.size() > 1) source.text = scene_with_includes(source, texts);
  return source;
}

SceneSource read_file(const std::string& path) {
  const std::filesystem::path at(path);
  SceneSource source{at.stem().string(), path,
                     core::read_input_file(path, "give the path of a scene file (TOML, MJCF or URDF)")};
  if (xml::is_xml(source.text)) return read_model_scene(std::move(source));
  for (auto missing = missing_files(source); !missing.empty(); missing = missing_files(source)) {
    for (const std::string& file : missing) {
      const std::string found = (at.parent_path() / file).string();
      source.text = with_file(
          source.text, file,
          core::read_input_file(found, path + " names it: give the path of a model file (MJCF or URDF)"));
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
