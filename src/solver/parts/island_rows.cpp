#include "solver/parts/island_rows.h"

namespace pbmpi::solver {

void IslandRows::reset(int num_bodies) {
  sets_.reset(num_bodies);
  rows_.assign(static_cast<std::size_t>(num_bodies), 0);
}

}  // namespace pbmpi::solver
