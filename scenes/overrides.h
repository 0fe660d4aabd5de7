/// What one world has otherwise than its scene says.
#pragma once

#include <string>
#include <vector>

namespace pbmpi::scenes {

/// One value of the scene, replaced.
struct Override {
  /// "ACTOR.KEY" or "JOINT.KEY" for what stands in the scene's [[actor]] or [[joint]] of that name,
  /// "world.KEY" for what stands outside of them; a KEY inside a table has its name before it, e.g.
  /// "car.material.mu", "world.contact.soft_erp".
  std::string key;
  std::string value;  ///< TOML, e.g. 5, true, "text", [1, 2, 3]
  std::string where;  ///< begins messages, e.g. "study.csv:3:7: column 'car.speed'"; empty: the key does
};

/// Laid over the scene one after the other.
using Overrides = std::vector<Override>;

}  // namespace pbmpi::scenes
