/// What Bullet has no word for, or another meaning.
#pragma once

#include <string>
#include <vector>

#include "model/model.h"

namespace pbmpi::bullet {

/// What of this model Bullet steps otherwise than ODE, or not at all, a line each, e.g. "max_per_pair 16: a
/// pair of geoms has 4 contacts at most".
std::vector<std::string> inexpressible(const model::Model& model);

}  // namespace pbmpi::bullet
