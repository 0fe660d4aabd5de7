/// Lays overrides, as TOML, over the TOML of their scene.
#pragma once

#include <toml++/toml.h>
#include <string>
#include <string_view>

#include "scenes/overrides.h"

namespace pbmpi::scenes {

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

}  // namespace pbmpi::scenes
