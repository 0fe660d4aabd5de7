/// Values of one world that differ from its scene.
#pragma once

#include <string>
#include <vector>

namespace pbmpi::scenes {

/// One replaced value of the scene.
struct Override {
  /// "ACTOR.KEY" or "JOINT.KEY" for keys of the scene's [[actor]] or [[joint]] of that name, "world.KEY" for
  /// keys outside of them; a KEY inside a table is prefixed with the table's name, e.g. "car.material.mu",
  /// "world.contact.soft_erp".
  std::string key;
  std::string value;  ///< TOML, e.g. 5, true, "text", [1, 2, 3]
  std::string where;  ///< begins messages, e.g. "study.csv:3:7: column 'car.speed'"; empty: the key does
};

/// Overrides are laid over the scene in this order.
using Overrides = std::vector<Override>;

}  // namespace pbmpi::scenes
