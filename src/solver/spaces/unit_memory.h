/// What a step hands on to the next, unit by unit, as it is sent between the ranks that solve the units.
#pragma once

#include <span>
#include <vector>

#include "model/space_map.h"
#include "model/step_memory.h"
#include "solver/layout/articulation.h"

namespace pbmpi::solver {

/// The units of a world; `articulations` [num_units] has their joints. Both are borrowed.
struct UnitMemory {
  const model::SpaceMap& map;
  std::span<const Articulation> articulations;

  /// The contact forces whose body a is in one of these units, and the forces of their joints: the number of
  /// contacts, a row for each, and a row for each joint if the memory has joints.
  std::vector<double> rows(std::span<const int> units, const model::StepMemory& memory) const;

  /// Inverse of rows(): replaces what `memory` holds of these units. `num_joints`: the model's.
  void put(std::span<const int> units, std::span<const double> rows, std::size_t num_joints,
           model::StepMemory& memory) const;
};

}  // namespace pbmpi::solver
