#include "scenes/scene_toml.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <sstream>
#include <string_view>

#include "core/error.h"
#include "core/text.h"
#include "scenes/actors/model_file.h"
#include "scenes/format/table_reader.h"
#include "scenes/meshes/mesh_file.h"
#include "scenes/xml/element.h"

namespace pbmpi::scenes {
namespace {

/// The name of a table in an array; nothing for anything else.
std::optional<std::string> name_of(const toml::node& entry) {
  const toml::table* table = entry.as_table();
  return table == nullptr ? std::nullopt : (*table)["name"].value<std::string>();
}

/// A compound's geoms have no names: a file that lists geoms replaces all of its base's.
constexpr std::string_view whole_array = "geoms";

bool is_array_of_tables(const toml::node& node) {
  const toml::array* array = node.as_array();
  return array && !array->empty() && (*array)[0].is_table();
}

/// A new entry needs the key that says what it is; without it a slip of the name is likelier.
void require_kind_of_new(const std::string& list, const std::string& name, const toml::node& entry,
                         const std::map<std::string, std::size_t>& index) {
  const std::string key = list == "actor" ? "type" : list == "joint" ? "kind" : "";
  if (key.empty() || entry.as_table()->contains(key)) return;
  std::vector<std::string> names;
  names.reserve(index.size());
  for (const auto& [known, at] : index) names.push_back(known);
  const std::string near = core::nearest_name(name, names);
  throw core::InputError(to_string(entry.source()) + ": " + list + " " + core::in_quotes(name) +
                         ": the base has none of this name, and a new one needs the key " +
                         core::in_quotes(key) +
                         (near.empty() ? "; add it" : "; did you mean " + core::in_quotes(near) + "?"));
}

/// `list`: the key of both arrays.
void merge_by_name(const std::string& list, toml::array& base, toml::array&& over) {
  std::map<std::string, std::size_t> index;  // of the first of a name
  const auto add = [&](const toml::node& entry, std::size_t at) {
    if (const auto name = name_of(entry)) index.emplace(*name, at);
  };
  for (std::size_t i = 0; i < base.size(); ++i) add(base[i], i);
  for (toml::node& entry : over) {
    const auto name = name_of(entry);
    const auto same = name ? index.find(*name) : index.end();
    if (same != index.end()) {
      lay_over(*base[same->second].as_table(), std::move(*entry.as_table()));
    } else {
      if (name) require_kind_of_new(list, *name, entry, index);
      add(entry, base.size());
      base.push_back(std::move(entry));
    }
  }
}

/// A case's expectations belong to its own numbers: a file with expectations replaces all of its base's.
void drop_replaced_expectations(toml::table& base, const toml::table& over) {
  toml::table* old = base["case"].as_table();
  if (old && over["case"]["expect"]) old->erase("expect");
}

/// The scene that `base` names, if this scene has a base.
std::optional<SceneSource> base_of(const toml::table& scene) {
  const toml::node* base_node = scene.get("base");
  if (!base_node) return std::nullopt;
  const std::string place = to_string(base_node->source());
  const auto base_name = base_node->value<std::string>();
  core::require_input(base_name && !base_name->ends_with(".toml"),
                      place + ": 'base' must name a scene that pbmpi brings (so that one file says it all)");
  try {
    return find_scene(*base_name);
  } catch (const core::InputError& error) {
    throw core::InputError(place + ": base: " + error.what());
  }
}

/// A model alone in its world must have a link that moves.
void require_mass(const links::Mechanism& mechanism, const std::string& file) {
  std::string names;
  for (const links::Link& link : mechanism.links) {
    if (link.mass) return;
    names += (names.empty() ? "" : ", ") + core::in_quotes(link.name);
  }
  throw core::InputError((mechanism.links.empty() ? file : mechanism.links.front().where) +
                         ": no body of the model moves, since these have no mass: " + names +
                         "; give what moves a mass and an inertia");
}

/// A scene with a model as its only actor: its frames are as close to 1/30 s as possible, and cover 10 s in
/// all.
toml::table scene_of_model(const SceneSource& source, const xml::Texts& texts) {
  xml::Notes told_later;  // the readers of the actor report these
  const links::ModelFile model = read_model_file(texts, source.file, {}, told_later);
  require_mass(model.mechanism, source.file);
  constexpr double frame_s = 1.0 / 30, run_s = 10;
  toml::table run;
  if (model.dt_s) {
    run.insert("dt", *model.dt_s);
    run.insert("steps_per_frame",
               std::max<std::int64_t>(1, std::llround(std::min(frame_s / *model.dt_s, 1e6))));
  }
  run.insert("frames", std::llround(run_s / frame_s));
  toml::table scene;
  const std::string& name = model.mechanism.name;
  scene.insert("title", (name.empty() ? source.name : name) + ", from " + source.file);
  scene.insert("run", std::move(run));
  if (model.gravity)
    scene.insert("gravity", toml::array{model.gravity->x(), model.gravity->y(), model.gravity->z()});
  scene.insert("overlap", std::numeric_limits<double>::infinity());  // as in the file's own simulator
  scene.insert("actor",
               toml::array{toml::table{{"name", source.name}, {"type", "model"}, {"file", source.file}}});
  return scene;
}

toml::table scene_of_one_file(const SceneSource& source) {
  toml::table scene = scene_of_model(source, {{source.file, source.text}});
  scene.insert("files", toml::table{{source.file, toml::table{{"text", source.text}}}});
  return scene;
}

/// The texts in the scene's [files].
xml::Texts texts_of(const toml::table& scene) {
  xml::Texts texts;
  if (const toml::table* files = scene["files"].as_table()) {
    for (const auto& [name, file] : *files) {
      if (const auto text = scene["files"][name.str()]["text"].value<std::string>())
        texts[std::string(name.str())] = *text;
    }
  }
  return texts;
}

/// The files of meshes that a hull, or the geoms of a compound, name.
std::vector<std::string> meshes_of(const toml::table& actor) {
  std::vector<std::string> meshes;
  if (const auto file = actor["file"].value<std::string>()) meshes.push_back(*file);
  if (const toml::array* geoms = actor["geoms"].as_array()) {
    for (const toml::node& geom : *geoms) {
      if (const toml::table* one = geom.as_table(); one != nullptr) {
        if (const auto file = (*one)["file"].value<std::string>()) meshes.push_back(*file);
      }
    }
  }
  std::erase_if(meshes, [](const std::string& file) { return !is_mesh_file(file); });
  return meshes;
}

}  // namespace

toml::table parse_text(const SceneSource& source) {
  try {
    return toml::parse(source.text, source.file);
  } catch (const toml::parse_error& error) {
    throw core::InputError(to_string(error.source()) +
                           ": malformed TOML: " + std::string(error.description()));
  }
}

// Nodes are moved, never copied: only a moved node keeps its place in its file.
void lay_over(toml::table& base, toml::table&& over) {
  for (auto&& [key, node] : over) {
    toml::node* old = base.get(key.str());
    if (old && old->is_table() && node.is_table()) {
      lay_over(*old->as_table(), std::move(*node.as_table()));
    } else if (old && is_array_of_tables(*old) && is_array_of_tables(node) && key.str() != whole_array) {
      merge_by_name(std::string(key.str()), *old->as_array(), std::move(*node.as_array()));
    } else {
      base.erase(key.str());  // the key must also report the new place
      base.insert_or_assign(key, std::move(node));
    }
  }
}

std::vector<SceneSource> bases_of(const SceneSource& source) {
  std::vector<SceneSource> bases;
  if (xml::is_xml(source.text)) return bases;
  for (auto base = base_of(parse_text(source)); base; base = base_of(parse_text(bases.back())))
    bases.push_back(*base);
  return bases;
}

toml::table parse_with_base(const SceneSource& source) {
  if (xml::is_xml(source.text)) return scene_of_one_file(source);
  toml::table scene = parse_text(source);
  const std::optional<SceneSource> base = base_of(scene);
  if (!base) return scene;
  toml::table result = parse_with_base(*base);
  drop_replaced_expectations(result, scene);
  scene.erase("base");
  lay_over(result, std::move(scene));
  return result;
}

std::vector<std::string> missing_files(const SceneSource& source) {
  std::vector<std::string> missing;
  if (xml::is_xml(source.text)) return missing;
  const toml::table scene = parse_text(source);
  const xml::Texts texts = texts_of(scene);
  const toml::array* actors = scene["actor"].as_array();
  if (actors == nullptr) return missing;
  for (const toml::node& node : *actors) {
    const toml::table* actor = node.as_table();
    if (actor == nullptr) continue;
    const auto add = [&](const std::string& file) {
      if (std::ranges::find(missing, file) == missing.end()) missing.push_back(file);
    };
    const auto file = (*actor)["file"].value<std::string>();
    if (file && (*actor)["type"].value<std::string>() == "model") {
      for (const std::string& one : missing_files(texts, *file)) add(one);
      continue;
    }
    for (const std::string& mesh : meshes_of(*actor)) {
      if (!texts.contains(mesh)) add(mesh);
    }
  }
  return missing;
}

std::set<std::string> surface_files(const SceneSource& source) {
  std::set<std::string> files;
  const toml::table scene = parse_text(source);
  const toml::array* actors = scene["actor"].as_array();
  if (actors == nullptr) return files;
  for (const toml::node& node : *actors) {
    const toml::table* actor = node.as_table();
    if (actor == nullptr || (*actor)["type"].value<std::string>() != "mesh") continue;
    if (const auto file = (*actor)["file"].value<std::string>()) files.insert(*file);
  }
  return files;
}

std::string with_file(const std::string& text, const std::string& file, const std::string& file_text) {
  return text + "\n[files." + toml_string(file) + "]\ntext = " + toml_string(file_text) + "\n";
}

std::string scene_with_includes(const SceneSource& model, const xml::Texts& texts) {
  std::ostringstream scene;
  scene << scene_of_model(model, texts) << '\n';
  std::string text = scene.str();
  for (const auto& [name, file_text] : texts) text = with_file(text, name, file_text);
  return text;
}

}  // namespace pbmpi::scenes
