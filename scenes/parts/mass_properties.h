/// Volumes and moments of inertia of solid bodies of uniform density.
#pragma once

#include <array>

#include "model/model.h"

namespace pbmpi::scenes {

/// Volume [m^3] of a solid shape; `size` as in model::Geom. Not for planes.
double volume(model::Shape shape, const std::array<double, 3>& size);

/// Inertia [kg m^2] about the centre of mass, in the shape's own axes (capsule and cylinder lie along z).
model::Mat3 solid_inertia(model::Shape shape, const std::array<double, 3>& size, double mass_kg);

}  // namespace pbmpi::scenes
