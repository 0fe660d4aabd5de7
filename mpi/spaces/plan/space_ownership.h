/// Which rank owns which space, and what follows from it: pure data, the same on every rank.
#pragma once

#include <vector>

#include "model/space_map.h"

namespace pbmpi::mpi {

struct SpaceOwnership {
  std::vector<int> owner;                ///< [num_spaces]
  std::vector<std::vector<int>> spaces;  ///< [num_ranks] ascending, as are the next two
  std::vector<std::vector<int>> units;   ///< [num_ranks]
  std::vector<std::vector<int>> bodies;  ///< [num_ranks]

  SpaceOwnership(const model::SpaceMap& map, std::vector<int> owner_of_space, int num_ranks);

  /// Do two ranks own bodies? Otherwise nothing can cross.
  bool is_divided() const;
};

}  // namespace pbmpi::mpi
