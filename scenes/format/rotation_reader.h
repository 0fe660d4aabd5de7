/// Rotations in scene files.
#pragma once

#include "scenes/format/table_reader.h"
#include "scenes/parts/parts.h"

namespace pbmpi::scenes {

/// Reads `rotation = { axis = [x, y, z], angle = deg }`; the identity without the key.
Quat read_rotation(TableReader& table);

}  // namespace pbmpi::scenes
