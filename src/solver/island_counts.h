/// Counts of the islands that one rank has solved.
#pragma once

#include <functional>
#include <span>

#include "model/contact.h"
#include "model/space_map.h"
#include "model/space_sleepers.h"
#include "model/space_stepper.h"

namespace pbmpi::solver {

/// Of these units (ascending) and all contacts that touch them. `joint_rows`: those of a unit's joints in the
/// last step, asked for awake units only. `sleepers` may be null; the islands that sleep count as such.
model::IslandCounts count_islands(const model::SpaceMap& map, std::span<const int> units,
                                  std::span<const model::Contact> contacts,
                                  const std::function<int(int unit)>& joint_rows,
                                  const model::SpaceSleepers* sleepers);

}  // namespace pbmpi::solver
