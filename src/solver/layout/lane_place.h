/// Where a body lies in a pack.
#pragma once

namespace pbmpi::solver {

/// A slot is a row of lanes; the body has one of its lanes.
struct LanePlace {
  int slot = 0, lane = 0;
};

}  // namespace pbmpi::solver
