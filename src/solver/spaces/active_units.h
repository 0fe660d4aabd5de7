/// Which units of a world cut into spaces a rank moves in a step.
#pragma once

#include <span>
#include <vector>

#include "effects/space_sleepers.h"
#include "model/space_map.h"

namespace pbmpi::solver {

/// No unit is active at the start.
class ActiveUnits {
 public:
  /// `map` is borrowed.
  explicit ActiveUnits(const model::SpaceMap& map) : map_(&map) {}

  void clear();
  /// Takes those of `units` (ascending) that have an awake body, or all without sleepers. False if that
  /// changes nothing. `may_sleep_in_part`: some bodies of a unit may sleep without the others, because its
  /// joints can break.
  bool set(std::span<const int> units, const effects::SpaceSleepers* sleepers, bool may_sleep_in_part);
  bool contains(int unit) const;
  /// The awake bodies of these units, unit by unit.
  const std::vector<int>& bodies() const { return bodies_; }

 private:
  const model::SpaceMap* map_;
  std::vector<int> units_;
  std::vector<int> bodies_;
};

}  // namespace pbmpi::solver
