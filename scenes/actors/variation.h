/// Differences between the replicas of a scene.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "scenes/format/table_reader.h"
#include "scenes/parts/parts.h"

namespace pbmpi::scenes {

/// Half-widths of uniform distributions around the values in the file.
struct Variation {
  Vec3 position = Vec3::Zero();  ///< [m]
  Vec3 velocity = Vec3::Zero();  ///< [m/s]
  double heading_deg = 0;

  bool is_none() const { return position.isZero(0) && velocity.isZero(0) && heading_deg == 0; }
};

/// The values drawn for one actor of one world.
struct Offset {
  Vec3 position = Vec3::Zero();
  Vec3 velocity = Vec3::Zero();
  double heading_deg = 0;
};

/// Reads `[variation]` of an actor; all zero without the table.
Variation read_variation(TableReader& actor);

/// Draws from the key (seed, world, actor) alone, independent of earlier draws.
Offset draw(const Variation& variation, std::uint64_t seed, int world, std::uint64_t actor);

/// An integer that may change with the world: pairs (first world, number), ascending from world 0.
class WorldCount {
 public:
  explicit WorldCount(int everywhere = 1) : steps_{{0, everywhere}} {}
  /// Reads `key = 3` or `key = [[0, 50], [4, 1]]` (50 from world 0 on, 1 from world 4 on).
  static WorldCount read(TableReader& table, std::string_view key);
  int in(int world) const;
  bool is_constant() const { return steps_.size() == 1; }

 private:
  std::vector<std::array<int, 2>> steps_;
};

}  // namespace pbmpi::scenes
