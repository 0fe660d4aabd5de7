#include "solver/worlds/group_plan.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

namespace pbmpi::solver {
namespace {

using stepping::Precision;

TEST(GroupPlan, deals_out_each_world_once_in_whole_batches) {
  for (const int lanes : {1, 2, 8, 16}) {
    for (int num_worlds = 1; num_worlds < 200; num_worlds += 7) {
      for (const int num_packs : {1, 2, 3, 7, 64}) {
        const GroupPlan plan(num_worlds, num_packs, lanes);
        const std::vector<int> sizes = plan.sizes();
        ASSERT_EQ(static_cast<int>(sizes.size()), plan.num_packs());
        EXPECT_EQ(std::accumulate(sizes.begin(), sizes.end(), 0), num_worlds);
        EXPECT_GT(std::ranges::min(sizes), 0);
        for (std::size_t i = 0; i + 1 < sizes.size(); ++i) {
          EXPECT_EQ(sizes[i] % lanes, 0);
          EXPECT_TRUE(plan.contains(sizes[i])) << sizes[i] << " of " << num_worlds;
        }
        EXPECT_LE(std::ranges::max(sizes) - std::ranges::min(sizes), 2 * lanes - 1)
            << "one batch more, and a last one that is not full";
      }
    }
  }
}

TEST(GroupPlan, has_as_many_packs_as_asked_for_where_there_are_batches) {
  EXPECT_EQ(GroupPlan(100, 7, 8).sizes(), (std::vector<int>{8, 16, 16, 16, 16, 16, 12}));
  EXPECT_EQ(GroupPlan(100, 3, 16).sizes(), (std::vector<int>{32, 32, 36}));
  EXPECT_EQ(GroupPlan(5, 4, 8).sizes(), std::vector<int>{5});
  EXPECT_EQ(GroupPlan(3, 4, 1).sizes(), (std::vector<int>{1, 1, 1}));
}

TEST(GroupPlan, knows_the_sizes_of_other_plans) {
  const GroupPlan plan(100, 7, 8);
  for (const int size : {0, 4, 7, 12, 24, 32}) EXPECT_FALSE(plan.contains(size)) << size;
}

TEST(GroupPlan, counts_packs_by_the_cache_and_by_the_threads) {
  // 1,800 bodies in float are a pack, 900 in double.
  EXPECT_EQ(packs_for(3600, 1, Precision::single, 1), 2);
  EXPECT_EQ(packs_for(3600, 1, Precision::double_, 1), 4);
  EXPECT_EQ(packs_for(10, 1, Precision::double_, 1), 1);
  EXPECT_EQ(packs_for(10, 1, Precision::double_, 3), 3);
  EXPECT_EQ(packs_for(3600, 1, Precision::double_, 3), 6) << "two rounds of three, not one and a third";
  EXPECT_EQ(packs_for(10, 0.25, Precision::double_, 8), 2)
      << "a quarter of the bodies gets a quarter of the threads";
  EXPECT_EQ(packs_for(10, 0.01, Precision::double_, 8), 1);
}

}  // namespace
}  // namespace pbmpi::solver
