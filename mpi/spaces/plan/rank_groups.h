/// Groups of ranks, each of which cuts worlds of its own into spaces: pure data, the same on every rank.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "model/space_map.h"
#include "mpi/balance/partition.h"

namespace pbmpi::mpi {

/// The ranks of a group are consecutive, and so are its worlds, which it steps one after the other. Ranks
/// after the last group are idle.
struct RankGroups {
  std::vector<int> ranks;   ///< [num_groups] number of ranks of each
  std::vector<int> worlds;  ///< [num_groups] number of worlds of each

  /// One group, of all ranks.
  static RankGroups of_all(int num_ranks, int num_worlds = 1) { return {{num_ranks}, {num_worlds}}; }

  int num_groups() const { return static_cast<int>(ranks.size()); }
  int num_worlds() const;
  int group_of_rank(int rank) const;            ///< num_groups() for an idle rank
  int first_rank(int group) const;              ///< root of the group, which reports its worlds
  int first_world(int group) const;             ///< numbered in the run, not in the ensemble
  std::vector<int> worlds_of(int group) const;  ///< ascending; none for num_groups()
  Placement roots() const;                      ///< [num_worlds] root of the group of each world
};

/// [num_spaces] the predicted cost of each space before anything is measured: the rows of its joints, and its
/// bodies.
std::vector<double> space_costs(const model::SpaceMap& map);

/// Cost of the busiest of `num_ranks` ranks that share a world's spaces by longest processing time first. It
/// is at least the cost of the largest space, so more ranks than spaces gain nothing.
double cut_cost(std::span<const double> space_costs, int num_ranks);

/// The smallest number of groups that have at most `ranks_per_world` ranks each, but never more than worlds;
/// their sizes are as equal as possible. Each world goes to the group that is predicted to finish it first.
RankGroups group_ranks(std::span<const double> space_costs, int num_worlds, int num_ranks,
                       int ranks_per_world);

/// Predicted cost of the busiest group.
double makespan(std::span<const double> space_costs, const RankGroups& groups);

/// The `ranks_per_world` with the least makespan, and the fewest among those within a tenth of each other:
/// the gain of a cut must be worth its messages, whose cost is not predicted. 1 if no cut is.
int choose_ranks_per_world(std::span<const double> space_costs, int num_worlds, int num_ranks);

/// "2:34,2:33,1:33": ranks and worlds of each group, as files have them.
std::string to_text(const RankGroups& groups);
/// No groups where the text has another form, as in files without groups.
RankGroups rank_groups_from_text(const std::string& text);

/// "3 groups of 1 to 2 ranks"
std::string in_words(const RankGroups& groups);

}  // namespace pbmpi::mpi
