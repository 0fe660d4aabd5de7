#include "mpi/spaces/plan/space_ownership.h"

#include <algorithm>
#include <utility>

namespace pbmpi::mpi {

SpaceOwnership::SpaceOwnership(const model::SpaceMap& map, std::vector<int> owner_of_space, int num_ranks)
    : owner(std::move(owner_of_space)), spaces(num_ranks), units(num_ranks), bodies(num_ranks) {
  for (int space = 0; space < map.num_spaces(); ++space) spaces[owner[space]].push_back(space);
  for (int unit = 0; unit < map.num_units(); ++unit) units[owner[map.space_of_unit[unit]]].push_back(unit);
  for (int body = 0; body < static_cast<int>(map.unit_of_body.size()); ++body)
    bodies[owner[map.space_of_body(body)]].push_back(body);
}

bool SpaceOwnership::is_divided() const {
  return std::count_if(bodies.begin(), bodies.end(), [](const auto& own) { return !own.empty(); }) > 1;
}

}  // namespace pbmpi::mpi
