/// Lists the features of a model that Bullet cannot express, or treats differently.
#pragma once

#include <string>
#include <vector>

#include "model/model.h"

namespace pbmpi::bullet {

/// The features of this model that Bullet steps differently from ODE, or not at all, one per line, e.g.
/// "max_per_pair 16: a pair of geoms has 4 contacts at most".
std::vector<std::string> inexpressible(const model::Model& model);

}  // namespace pbmpi::bullet
