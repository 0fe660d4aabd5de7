/// The scene files that are embedded in the program.
#pragma once

#include <span>
#include <string_view>

#include "scenes/scene.h"

namespace pbmpi::scenes {

struct EmbeddedScene {
  SceneGroup group;
  std::string_view name;
  std::string_view text;
};

/// The scenes by group, in the order of list_scenes(). The source is generated at build time from
/// scenes/*.toml, scenes/effects/*.toml, scenes/exact/*.toml and scenes/hard/*/*.toml.
std::span<const EmbeddedScene> embedded_scenes();

}  // namespace pbmpi::scenes
