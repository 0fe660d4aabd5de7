/// Reads a scene file's settings of the world as a whole.
#pragma once

#include "model/model.h"
#include "scenes/format/table_reader.h"

namespace pbmpi::scenes {

/// Reads gravity, solver constants, damping, [air], [contact], [sleep], `spaces` and `inter_space` into the
/// model from which every world starts.
void read_world(TableReader& scene, model::Model& world);

}  // namespace pbmpi::scenes
