#include "mpi/spaces/plan/rank_groups.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

namespace pbmpi::mpi {
namespace {

// Costs are small integers, so nothing here is rounded.
using Costs = std::vector<double>;
using Counts = std::vector<int>;

const Costs four_alike = {1, 1, 1, 1};

TEST(RankGroups, give_each_rank_and_each_world_to_one_group_for_any_numbers) {
  for (int num_worlds = 1; num_worlds <= 9; ++num_worlds) {
    for (int num_ranks = 1; num_ranks <= 9; ++num_ranks) {
      for (int ranks_per_world = 1; ranks_per_world <= 10; ++ranks_per_world) {
        const RankGroups groups = group_ranks(Costs{3, 1, 2, 2}, num_worlds, num_ranks, ranks_per_world);
        const auto [fewest, most] = std::ranges::minmax(groups.ranks);
        ASSERT_GE(fewest, 1);
        ASSERT_LE(most, ranks_per_world);
        ASSERT_LE(most - fewest, 1) << "as equal as can be";
        ASSERT_GE(std::ranges::min(groups.worlds), 1);
        ASSERT_EQ(groups.num_worlds(), num_worlds);
        const int used = std::accumulate(groups.ranks.begin(), groups.ranks.end(), 0);
        ASSERT_EQ(used, std::min(num_ranks, groups.num_groups() * ranks_per_world));
        for (int rank = 0; rank < num_ranks; ++rank) {
          const int group = groups.group_of_rank(rank);
          ASSERT_EQ(group == groups.num_groups(), rank >= used);
          if (rank >= used) {
            ASSERT_TRUE(groups.worlds_of(group).empty());
          } else {
            ASSERT_GE(rank, groups.first_rank(group));
            ASSERT_LT(rank, groups.first_rank(group) + groups.ranks[group]);
          }
        }
        const Placement roots = groups.roots();
        ASSERT_EQ(std::ssize(roots), num_worlds);
        for (int world = 0; world < num_worlds; ++world) {
          const Counts own = groups.worlds_of(groups.group_of_rank(roots[world]));
          ASSERT_EQ(std::ranges::count(own, world), 1);
        }
      }
    }
  }
}

TEST(RankGroups, leave_ranks_idle_rather_than_give_a_world_more_than_asked_for) {
  EXPECT_EQ(group_ranks(four_alike, 2, 5, 2).ranks, (Counts{2, 2}));
  EXPECT_EQ(group_ranks(four_alike, 3, 8, 2).ranks, (Counts{2, 2, 2}));
  EXPECT_EQ(group_ranks(four_alike, 1, 8, 3).ranks, (Counts{3}));
  EXPECT_EQ(group_ranks(four_alike, 2, 4, 1).ranks, (Counts{1, 1}));
}

TEST(RankGroups, give_more_worlds_to_larger_groups) {
  // Two ranks finish a world in half of the time.
  const RankGroups uneven = group_ranks(four_alike, 6, 3, 2);
  EXPECT_EQ(uneven.ranks, (Counts{2, 1}));
  EXPECT_EQ(uneven.worlds, (Counts{4, 2}));
  EXPECT_EQ(makespan(four_alike, uneven), 8);
  // One space has all the work, so a second rank does not help.
  EXPECT_EQ(group_ranks(Costs{4, 0}, 6, 3, 2).worlds, (Counts{3, 3}));
}

TEST(RankGroups, are_bounded_by_the_largest_space) {
  EXPECT_EQ(cut_cost(four_alike, 1), 4);
  EXPECT_EQ(cut_cost(four_alike, 3), 2);
  EXPECT_EQ(cut_cost(four_alike, 4), 1);
  EXPECT_EQ(cut_cost(four_alike, 100), 1);
  EXPECT_EQ(cut_cost(Costs{7, 1, 1, 1}, 4), 7);
}

TEST(RankGroups, are_of_as_few_ranks_as_reach_the_least_makespan) {
  EXPECT_EQ(choose_ranks_per_world(four_alike, 2, 8), 4);
  EXPECT_EQ(choose_ranks_per_world(four_alike, 2, 4), 2);
  EXPECT_EQ(choose_ranks_per_world(four_alike, 4, 4), 1) << "no cut is done sooner than a world a rank";
  EXPECT_EQ(choose_ranks_per_world(four_alike, 100, 1), 1);
  EXPECT_EQ(choose_ranks_per_world(four_alike, 1, 100), 4) << "more ranks than spaces bring nothing";
  EXPECT_EQ(choose_ranks_per_world(Costs{6, 2, 2, 2}, 2, 8), 2)
      << "the largest space is left on a rank of its own";
  EXPECT_EQ(choose_ranks_per_world(Costs{9, 1}, 2, 4), 2);
  EXPECT_EQ(choose_ranks_per_world(Costs{8}, 2, 4), 1);
}

TEST(RankGroups, grow_only_if_that_is_predicted_to_gain_a_tenth) {
  // A cut in two saves two parts of 21, and one part.
  EXPECT_EQ(choose_ranks_per_world(Costs{19, 2}, 1, 2), 2);
  EXPECT_EQ(choose_ranks_per_world(Costs{20, 1}, 1, 2), 1);
  // 13 worlds per rank against 25 halves for two ranks: a cut would save a twenty-fifth.
  EXPECT_EQ(choose_ranks_per_world(four_alike, 100, 8), 1);
}

}  // namespace
}  // namespace pbmpi::mpi
