/// One step taken apart: what each of its islands and collision spaces costs by itself.
#pragma once

#include <vector>

namespace pbmpi::stepping {

/// The size of one island's problem, and the time to solve it alone.
struct IslandCost {
  int first_body = 0;  ///< the island's lowest body
  int bodies = 0;
  int contacts = 0;  ///< contact points
  int rows = 0;      ///< scalar constraint rows of joints and contacts
  double solve_s = 0;
};

/// The step that ended the last advance(), measured again after it.
struct StepProfile {
  std::vector<IslandCost> islands;  ///< in order of their lowest body
  double collide_s = 0;             ///< collision detection as one piece
  /// Collision detection if each space had a core: the slowest space, then what lies between two spaces. The
  /// time of the broad phase is divided among the spaces by their numbers of geoms.
  double collide_spaces_s = 0;
  int cross_contacts = 0;  ///< contact points between bodies of different spaces
};

}  // namespace pbmpi::stepping
