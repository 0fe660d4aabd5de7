#include "solver/spaces/island_counts.h"

#include <algorithm>
#include <vector>

#include "solver/parts/island_rows.h"

namespace pbmpi::solver {

stepping::Observables count_islands(const model::Model& model, const model::SpaceMap& map,
                                    std::span<const Articulation> articulations, std::span<const int> units,
                                    std::span<const model::Contact> contacts,
                                    const std::function<std::optional<int>(int joint)>& joint_rows,
                                    const std::function<int(int body)>& sweeps,
                                    const effects::SpaceSleepers* sleepers) {
  const auto asleep = [&](int body) { return sleepers != nullptr && sleepers->asleep(body); };
  stepping::Observables counts;
  IslandRows island_rows;
  island_rows.reset(model.num_bodies());
  for (const model::Contact& contact : contacts) {
    island_rows.join(contact.body_a, contact.body_b);
    island_rows.add(contact.body_a, model::contact_rows(contact.mu));
    counts.max_penetration_m = std::max(counts.max_penetration_m, contact.depth);
  }
  std::vector<int> bodies;
  for (const int unit : units) {
    for (const int body : map.bodies_of_unit[unit]) {
      bodies.push_back(body);
      if (asleep(body)) island_rows.join(body, sleepers->island(body));
    }
    for (const int index : articulations[unit].joints) {
      const std::optional<int> acting_rows = joint_rows(index);
      if (!acting_rows) continue;
      const model::Joint& joint = model.joints[index];
      island_rows.join(joint.body_a, joint.body_b);
      if (!asleep(joint.body_a)) island_rows.add(joint.body_a, *acting_rows);
    }
  }
  island_rows.count(bodies, sweeps, counts);
  counts.contacts = static_cast<int>(contacts.size());
  return counts;
}

}  // namespace pbmpi::solver
