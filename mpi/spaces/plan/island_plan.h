/// Which rank solves which island in a step: pure data, without communication.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace pbmpi::mpi {

/// The islands that one rank forms from the joints and contacts of its own spaces alone.
struct LocalIslands {
  std::vector<std::int32_t> of_unit;  ///< [units of the rank] index into weight
  std::vector<std::int32_t> weight;   ///< [islands] rows + bodies: the cost of solving it, in rows
};

/// An island of one rank.
struct IslandRef {
  int rank = 0;
  int island = 0;
  bool operator==(const IslandRef&) const = default;
};

/// A contact across spaces joins two islands of different ranks.
struct IslandLink {
  IslandRef a, b;
};

/// An island that is solved on a rank other than its own.
struct Transfer {
  IslandRef island;
  int to = 0;
  bool operator==(const Transfer&) const = default;
};

struct IslandPlan {
  std::vector<Transfer> transfers;  ///< by (rank, island)
  std::vector<int> solver_of_link;  ///< [links] rank that solves the contact
};

/// Islands that no link touches stay where they are. Joined islands are solved on one of their ranks: the one
/// with the largest part, unless that would make it the last to finish and another of their ranks would be
/// done sooner. Heaviest first; ties go to the lower rank. Deterministic.
IslandPlan plan_islands(std::span<const LocalIslands> ranks, std::span<const IslandLink> links);

}  // namespace pbmpi::mpi
