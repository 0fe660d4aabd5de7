/// Turns a scene's text, with its bases and overrides, into one TOML table.
#pragma once

#include <set>
#include <string>

#include <toml++/toml.h>

#include "scenes/scene.h"
#include "scenes/xml/include.h"

namespace pbmpi::scenes {

/// Parses the text; if it names a `base`, parses that scene too and lays this one over it: tables merge key
/// by key, [[actor]] and [[joint]] entries merge with base entries of the same name or are appended; [[pair]]
/// and [[event]] entries are appended; [[case.expect]] and all other values replace the base's. Every node
/// keeps its file, line and column. A base is always a scene that comes with pbmpi, so a scene's text alone
/// determines the scene. An XML text becomes a scene whose only actor is the model, with the gravity and the
/// step that the model proposes. Throws core::InputError.
toml::table parse_with_base(const SceneSource& source);

/// Parses the text alone. Throws core::InputError.
toml::table parse_text(const SceneSource& source);

/// Lays a table over its base as parse_with_base() does.
void lay_over(toml::table& base, toml::table&& over);

/// Lays each override over `scene` as a scene file is laid over its base (lay_over()), so that readers find
/// it where a file would have it, and report an error at the override's place. Throws core::InputError for a
/// key that names no actor or joint of the scene (with the nearest names) or that all worlds of a run share,
/// and for a value that is not TOML. Errors that only a reader can see (keys of an actor, ranges) are left to
/// the readers.
void lay_overrides(toml::table& scene, const Overrides& overrides);

/// A value as TOML. Its texts are quoted, on one line, with escapes for every character that needs one: a
/// multi-line literal could not hold ''' and would lose a leading line break.
std::string toml_text(const toml::node& value);
std::string toml_string(std::string_view text);

/// The model files that a scene's actors name, and those that these include, whose texts the scene does not
/// have. None for a scene that is a model itself.
std::vector<std::string> missing_files(const SceneSource& source);

/// The files of which a scene's actors need all triangles.
std::set<std::string> surface_files(const SceneSource& source);

/// `text` with the text of a file appended, in the form that missing_files() looks for.
std::string with_file(const std::string& text, const std::string& file, const std::string& file_text);

/// A model that includes other files, as the TOML scene that parse_with_base() would make of it, with all
/// texts.
std::string scene_with_includes(const SceneSource& model, const xml::Texts& texts);

}  // namespace pbmpi::scenes
