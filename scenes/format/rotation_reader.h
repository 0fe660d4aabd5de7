/// Rotations in scene files.
#pragma once

#include "scenes/format/table_reader.h"
#include "scenes/parts/parts.h"

namespace pbmpi::scenes {

/// Reads `key = { axis = [x, y, z], angle = deg }`; the identity without the key.
Quat read_rotation(TableReader& table, std::string_view key = "rotation");

}  // namespace pbmpi::scenes
