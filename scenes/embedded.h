/// The scene files that are part of the program.
#pragma once

#include <span>
#include <string_view>

namespace pbmpi::scenes {

struct EmbeddedScene {
  std::string_view name;
  std::string_view text;
};

/// In the order of the paper's Table 1. The source is generated from scenes/*.toml at build time.
std::span<const EmbeddedScene> embedded_scenes();

}  // namespace pbmpi::scenes
