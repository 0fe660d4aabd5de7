#include "solver/island_counts.h"

#include <algorithm>
#include <vector>

#include "model/islands.h"

namespace pbmpi::solver {

model::IslandCounts count_islands(const model::SpaceMap& map, std::span<const int> units,
                                  std::span<const model::Contact> contacts,
                                  const std::function<int(int unit)>& joint_rows,
                                  const model::SpaceSleepers* sleepers) {
  model::IslandCounts counts;
  model::DisjointSets sets(map.num_units());
  std::vector<int> rows(static_cast<std::size_t>(map.num_units()), 0);
  for (const model::Contact& contact : contacts) {
    const int unit = map.unit_of_body[contact.body_a];
    if (contact.body_b != model::no_body) sets.unite(unit, map.unit_of_body[contact.body_b]);
    rows[unit] += contact.mu > 0 ? 3 : 1;
    counts.max_penetration_m = std::max(counts.max_penetration_m, contact.depth);
  }
  for (const int unit : units) {
    const int body = map.bodies_of_unit[unit].front();
    if (sleepers != nullptr && sleepers->asleep(body)) {
      sets.unite(unit, map.unit_of_body[sleepers->island(body)]);
    } else {
      rows[unit] += joint_rows(unit);
    }
  }
  std::vector<int> island_rows(rows.size(), 0);
  for (const int unit : units) {
    const int island = sets.find(unit);
    counts.islands += island == unit ? 1 : 0;
    island_rows[island] += rows[unit];
    counts.rows += rows[unit];
  }
  counts.contacts = static_cast<int>(contacts.size());
  counts.max_island_rows = *std::max_element(island_rows.begin(), island_rows.end());
  return counts;
}

}  // namespace pbmpi::solver
