#include "solver/spaces/island_counts.h"

#include <algorithm>
#include <vector>

#include "model/islands.h"

namespace pbmpi::solver {

stepping::Observables count_islands(const model::Model& model, const model::SpaceMap& map,
                                    std::span<const Articulation> articulations, std::span<const int> units,
                                    std::span<const model::Contact> contacts,
                                    const std::function<std::optional<int>(int joint)>& joint_rows,
                                    const std::function<int(int body)>& sweeps,
                                    const effects::SpaceSleepers* sleepers) {
  const auto asleep = [&](int body) { return sleepers != nullptr && sleepers->asleep(body); };
  stepping::Observables counts;
  model::DisjointSets sets(model.num_bodies());
  std::vector<int> rows(model.bodies.size(), 0);
  for (const model::Contact& contact : contacts) {
    if (contact.body_b != model::no_body) sets.unite(contact.body_a, contact.body_b);
    rows[contact.body_a] += model::contact_rows(contact.mu);
    counts.max_penetration_m = std::max(counts.max_penetration_m, contact.depth);
  }
  for (const int unit : units) {
    for (const int body : map.bodies_of_unit[unit]) {
      if (asleep(body)) sets.unite(body, sleepers->island(body));
    }
    for (const int index : articulations[unit].joints) {
      const std::optional<int> acting_rows = joint_rows(index);
      if (!acting_rows) continue;
      const model::Joint& joint = model.joints[index];
      if (joint.body_b != model::no_body) sets.unite(joint.body_a, joint.body_b);
      if (!asleep(joint.body_a)) rows[joint.body_a] += *acting_rows;
    }
  }
  std::vector<int> island_rows(rows.size(), 0);
  for (const int unit : units) {
    for (const int body : map.bodies_of_unit[unit]) {
      const int island = sets.find(body);
      counts.islands += island == body ? 1 : 0;
      island_rows[island] += rows[body];
      counts.rows += rows[body];
      if (rows[body] > 0) counts.row_visits += static_cast<double>(rows[body]) * sweeps(body);
    }
  }
  counts.contacts = static_cast<int>(contacts.size());
  counts.max_island_rows = *std::max_element(island_rows.begin(), island_rows.end());
  return counts;
}

}  // namespace pbmpi::solver
