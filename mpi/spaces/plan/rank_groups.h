/// Groups of ranks, each of which cuts worlds of its own into spaces: pure data, the same on every rank.
#pragma once

#include <span>
#include <vector>

#include "model/space_map.h"
#include "mpi/balance/partition.h"

namespace pbmpi::mpi {

/// The ranks of a group are consecutive, and so are its worlds, which it steps one after the other. Ranks
/// behind the last group are idle.
struct RankGroups {
  std::vector<int> ranks;   ///< [num_groups] how many of each
  std::vector<int> worlds;  ///< [num_groups]

  /// One group, of all ranks.
  static RankGroups of_all(int num_ranks, int num_worlds = 1) { return {{num_ranks}, {num_worlds}}; }

  int num_groups() const { return static_cast<int>(ranks.size()); }
  int num_worlds() const;
  int group_of_rank(int rank) const;            ///< num_groups() for a rank that is idle
  int first_rank(int group) const;              ///< root of the group, who reports its worlds
  int first_world(int group) const;             ///< of run, not of the ensemble
  std::vector<int> worlds_of(int group) const;  ///< ascending; none for num_groups()
  Placement roots() const;                      ///< [num_worlds] root of the group of each world
};

/// [num_spaces] What each space costs before anything is measured: the rows of its joints, and its bodies.
std::vector<double> space_costs(const model::SpaceMap& map);

/// Owners of spaces before anything is measured: longest processing time first.
std::vector<int> initial_owners(const model::SpaceMap& map, int num_ranks);

/// Cost of the busiest of `num_ranks` ranks under initial_owners(): that of the largest space at least, so
/// that more ranks than spaces bring nothing.
double cut_cost(std::span<const double> space_costs, int num_ranks);

/// As many groups as it takes for each to have at most `ranks_per_world` ranks, but never more than worlds;
/// as equal as can be. Each world goes to the group that is predicted to be done with it first.
RankGroups group_ranks(std::span<const double> space_costs, int num_worlds, int num_ranks,
                       int ranks_per_world);

/// Cost of the group that is predicted to be busiest.
double makespan(std::span<const double> space_costs, const RankGroups& groups);

/// The `ranks_per_world` with the least makespan, and of those within a tenth of each other the fewest: what
/// a cut gains must be worth its messages, of which nothing is predicted. 1: no cut does.
int choose_ranks_per_world(std::span<const double> space_costs, int num_worlds, int num_ranks);

}  // namespace pbmpi::mpi
