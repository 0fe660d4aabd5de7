/// From a scene's text to one TOML table, bases included.
#pragma once

#include <toml++/toml.h>

#include "scenes/scene.h"

namespace pbmpi::scenes {

/// Parses the text; if it names a `base`, parses that scene too and lays this one over it: tables merge key
/// by key, [[actor]] and [[joint]] entries merge with those of the same name or are appended, as are [[pair]]
/// and [[event]] entries; [[case.expect]] replaces the base's, as does anything else. Every node keeps its
/// file, line and column. A base is one of the scenes that pbmpi brings, so that a scene's text alone says
/// what it is. Throws core::InputError.
toml::table parse_with_base(const SceneSource& source);

}  // namespace pbmpi::scenes
