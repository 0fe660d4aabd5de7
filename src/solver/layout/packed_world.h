/// What a pack needs to know of the worlds that it steps.
#pragma once

#include <optional>
#include <vector>

#include "model/contact.h"
#include "model/model.h"
#include "solver/layout/articulation.h"

namespace pbmpi::solver {

/// A world in a pack, with what the pack needs to know of its model.
struct PackedWorld {
  const model::Model* model = nullptr;
  std::vector<Articulation> articulations;
  model::NarrowPhase* fallback = nullptr;  ///< collides the pairs that the lanes do not handle
  bool lanes_collide = true;               ///< false: the fallback collides all pairs
  double contact_margin_m = 0;             ///< the lanes find contacts between geoms up to this far apart
  /// No body that moves by less in a step approaches others (effects/fast_bodies.h) [m].
  double most_approach_m = model::infinity;
  bool in_parts = false;  ///< do steps move some islands separately from others?
  /// The geoms that collide() tests, ascending; none: all geoms of the model.
  std::optional<std::vector<int>> swept_geoms = std::nullopt;
};

}  // namespace pbmpi::solver
