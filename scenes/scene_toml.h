/// From a scene's text to one TOML table, bases included.
#pragma once

#include <toml++/toml.h>

#include "scenes/scene.h"

namespace pbmpi::scenes {

/// Parses the text; if it names a `base`, parses that scene too and lays this one over it: tables merge key
/// by key, [[actor]] and [[joint]] entries merge with those of the same name or are appended, as are [[pair]]
/// and [[event]] entries; [[case.expect]] replaces the base's, as does anything else. Every node keeps its
/// file, line and column. A base is one of the scenes that pbmpi brings, so that a scene's text alone says
/// what it is. A text in XML becomes the scene of one actor, the model, with the gravity and the step that it
/// proposes. Throws core::InputError.
toml::table parse_with_base(const SceneSource& source);

/// Parses the text alone. Throws core::InputError.
toml::table parse_text(const SceneSource& source);

/// Lays a table over its base, as parse_with_base() says.
void lay_over(toml::table& base, toml::table&& over);

/// The model files that a scene's actors name and whose texts it does not have.
std::vector<std::string> missing_files(const SceneSource& source);

/// `text` with the text of a file behind it, as missing_files() wants it.
std::string with_file(const std::string& text, const std::string& file, const std::string& file_text);

}  // namespace pbmpi::scenes
