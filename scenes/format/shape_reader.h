/// Shapes and their sizes in scene files.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "model/model.h"
#include "scenes/format/table_reader.h"

namespace pbmpi::scenes {

/// The shapes that enclose a volume, and their names.
const std::vector<model::Shape>& solid_shapes();

/// Reads `shape = "box"`, one of `allowed`.
model::Shape read_shape(TableReader& table, std::span<const model::Shape> allowed);

/// Reads the keys `size`, `radius` and `length` that a solid shape has, all above 0, as Geom::size [m].
std::array<double, 3> read_size(TableReader& table, model::Shape shape);

}  // namespace pbmpi::scenes
