/// How the articulations of a world cut into spaces lie in one rank's pack.
#pragma once

#include <span>
#include <vector>

#include "model/space_map.h"
#include "solver/pack/pack.h"

namespace pbmpi::solver {

/// The articulations of one space lie side by side, own spaces first, so that the batches of a rank hold few
/// lanes that it does not move. Only own geoms and static ones are swept. `is_own` [num_spaces]; the model is
/// borrowed.
PackedWorld pack_own_first(const model::Model& model, const model::SpaceMap& map,
                           std::span<const Articulation> articulations, std::span<const char> is_own);

}  // namespace pbmpi::solver
