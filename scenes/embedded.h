/// The scene files that are part of the program.
#pragma once

#include <span>
#include <string_view>

namespace pbmpi::scenes {

struct EmbeddedScene {
  std::string_view name;
  std::string_view text;
};

/// First the paper's, in the order of its Table 1, then the hard cases by name. The source is generated from
/// scenes/*.toml and scenes/hard/*/*.toml at build time.
std::span<const EmbeddedScene> embedded_scenes();

}  // namespace pbmpi::scenes
