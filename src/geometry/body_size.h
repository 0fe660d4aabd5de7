/// How large the bodies of a model are.
#pragma once

#include <vector>

#include "model/model.h"

namespace pbmpi::geometry {

/// [num_bodies] Diameter of the ball about its centre of mass that holds a body's geoms [m]; 0 for a body
/// without geoms.
std::vector<double> sizes_of(const model::Model& model);

}  // namespace pbmpi::geometry
