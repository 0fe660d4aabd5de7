/// Which rank owns which space, and what follows from it: pure data, the same on every rank.
#pragma once

#include <vector>

#include "model/space_map.h"

namespace pbmpi::mpi {

struct SpaceOwnership {
  std::vector<int> owner;                ///< [num_spaces] rank that owns each
  std::vector<std::vector<int>> spaces;  ///< [num_ranks] each rank's spaces, ascending
  std::vector<std::vector<int>> units;   ///< [num_ranks] each rank's units, ascending
  std::vector<std::vector<int>> bodies;  ///< [num_ranks] each rank's bodies, ascending

  SpaceOwnership(const model::SpaceMap& map, std::vector<int> owner_of_space, int num_ranks);

  /// Do two ranks own bodies? Otherwise nothing can cross.
  bool is_divided() const;
};

}  // namespace pbmpi::mpi
