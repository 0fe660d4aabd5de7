/// Overrides as TOML, laid over that of their scene.
#pragma once

#include <toml++/toml.h>
#include <string>
#include <string_view>

#include "scenes/overrides.h"

namespace pbmpi::scenes {

/// Lays each override over `scene` as a scene file is laid over its base (lay_over()), so that readers find
/// it where a file would have it, and tell a mistake at the override's place. Throws core::InputError: a key
/// that names no actor or joint of the scene (with the nearest names), or what the worlds of a run have in
/// common; a value that is no TOML. What only a reader knows (keys of an actor, ranges) is for readers to
/// find.
void lay_overrides(toml::table& scene, const Overrides& overrides);

/// A value as TOML. Its texts stand in quotes, in one line, where everything that a text may hold has an
/// escape: ''' ends one that is spread over lines, which also loses a line break that it begins with.
std::string toml_text(const toml::node& value);
std::string toml_string(std::string_view text);

}  // namespace pbmpi::scenes
