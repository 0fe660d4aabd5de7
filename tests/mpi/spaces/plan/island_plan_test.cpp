#include "mpi/spaces/plan/island_plan.h"

#include <gtest/gtest.h>

namespace pbmpi::mpi {
namespace {

/// Ranks whose islands have these weights, one unit each.
std::vector<LocalIslands> ranks_of(const std::vector<std::vector<int>>& weights) {
  std::vector<LocalIslands> ranks;
  for (const std::vector<int>& rank : weights) {
    LocalIslands islands;
    for (std::size_t i = 0; i < rank.size(); ++i) {
      islands.of_unit.push_back(static_cast<std::int32_t>(i));
      islands.weight.push_back(rank[i]);
    }
    ranks.push_back(islands);
  }
  return ranks;
}

IslandPlan plan_of(const std::vector<std::vector<int>>& weights, const std::vector<IslandLink>& links) {
  return plan_islands(ranks_of(weights), links);
}

TEST(IslandPlan, leaves_islands_where_they_are_if_nothing_links_them) {
  const IslandPlan plan = plan_of({{10, 1}, {2}}, {});
  EXPECT_TRUE(plan.transfers.empty());
}

TEST(IslandPlan, moves_the_smaller_part_of_an_island) {
  const IslandPlan plan = plan_of({{10, 100}, {4, 120}}, {{{0, 0}, {1, 0}}});
  EXPECT_EQ(plan.transfers, (std::vector<Transfer>{{{1, 0}, 0}}));
  EXPECT_EQ(plan.solver_of_link, std::vector<int>{0});
}

TEST(IslandPlan, gives_an_island_to_the_rank_that_is_done_sooner_if_its_home_would_be_last) {
  const IslandPlan plan = plan_of({{10, 100}, {8, 20}}, {{{0, 0}, {1, 0}}});
  EXPECT_EQ(plan.transfers, (std::vector<Transfer>{{{0, 0}, 1}}));
  EXPECT_EQ(plan.solver_of_link, std::vector<int>{1});
}

TEST(IslandPlan, joins_through_several_ranks_and_gives_all_parts_and_links_to_one) {
  const IslandPlan plan =
      plan_of({{3, 50}, {4, 50}, {5, 50}}, {{{0, 0}, {1, 0}}, {{2, 0}, {1, 0}}, {{0, 0}, {1, 0}}});
  ASSERT_EQ(plan.transfers.size(), 2u);
  const int solver = plan.transfers.front().to;
  for (const Transfer& transfer : plan.transfers) {
    EXPECT_EQ(transfer.to, solver);
    EXPECT_NE(transfer.island.rank, solver);
    EXPECT_EQ(transfer.island.island, 0);
  }
  EXPECT_EQ(plan.solver_of_link, std::vector<int>(3, solver));
}

TEST(IslandPlan, keeps_separate_islands_apart) {
  const IslandPlan plan = plan_of({{6, 1}, {1, 6}}, {{{0, 0}, {1, 0}}, {{0, 1}, {1, 1}}});
  EXPECT_EQ(plan.transfers, (std::vector<Transfer>{{{0, 1}, 1}, {{1, 0}, 0}}));
  EXPECT_EQ(plan.solver_of_link, (std::vector<int>{0, 1}));
}

}  // namespace
}  // namespace pbmpi::mpi
