#include "mpi/spaces/step/rank_islands.h"

#include <algorithm>
#include <cmath>

#include "model/islands.h"
#include "mpi/spaces/step/wire.h"

namespace pbmpi::mpi {

void RankIslands::form(std::span<const model::Contact> contacts) {
  if (formed_) return;
  formed_ = true;
  const model::SpaceMap& map = shared_->stepper->map();
  model::DisjointSets sets(map.num_units());
  std::vector<std::int32_t> weight(static_cast<std::size_t>(map.num_units()), 0);
  for (const model::Contact& contact : contacts) {
    const int unit = map.unit_of_body[contact.body_a];
    weight[unit] += model::contact_rows(contact.mu);
    if (contact.body_b != model::no_body) sets.unite(unit, map.unit_of_body[contact.body_b]);
  }
  std::vector<std::int32_t> island(static_cast<std::size_t>(map.num_units()), -1);
  islands_.of_unit.clear();
  islands_.weight.clear();
  unit_weight_.clear();
  for (const int unit : shared_->own_units()) {
    const int lowest = sets.find(unit);
    if (lowest == unit) {
      island[unit] = static_cast<std::int32_t>(islands_.weight.size());
      islands_.weight.push_back(0);
    }
    islands_.of_unit.push_back(island[lowest]);
    unit_weight_.push_back(weight[unit] + map.rows_of_unit[unit] +
                           static_cast<std::int32_t>(map.bodies_of_unit[unit].size()));
    islands_.weight[island[lowest]] += unit_weight_.back();
  }
  if (shared_->field != nullptr) discount_outside();
}

/// An island without a body inside the field of interest is solved with few iterations, and weighs less. A
/// contact across spaces may still join it to a body inside, which only the rank that solves the island can
/// know.
void RankIslands::discount_outside() {
  const effects::FieldOfInterest& field = *shared_->field;
  const model::SpaceMap& map = shared_->stepper->map();
  const model::State& state = shared_->stepper->state();
  const std::vector<int>& own_units = shared_->own_units();
  std::vector<char> near(islands_.weight.size(), 0);
  unit_near_.clear();
  for (std::size_t i = 0; i < own_units.size(); ++i) {
    const std::vector<int>& bodies = map.bodies_of_unit[own_units[i]];
    const bool is_near = std::any_of(bodies.begin(), bodies.end(),
                                     [&](int body) { return field.is_near(state.position[body]); });
    unit_near_.push_back(is_near ? 1 : 0);
    near[islands_.of_unit[i]] |= unit_near_.back();
  }
  for (std::size_t island = 0; island < near.size(); ++island) {
    if (near[island]) continue;
    islands_.weight[island] =
        static_cast<std::int32_t>(std::ceil(field.outside_share() * islands_.weight[island]));
  }
}

}  // namespace pbmpi::mpi
