/// The joints of a model, body by body.
#pragma once

#include <vector>

#include "model/model.h"

namespace pbmpi::solver {

struct JointsOfBodies {
  explicit JointsOfBodies(const model::Model& model);

  std::vector<int> first;   ///< [num_bodies + 1] index into `joints`
  std::vector<int> joints;  ///< sorted by their first bodies, each body's ascending
};

}  // namespace pbmpi::solver
