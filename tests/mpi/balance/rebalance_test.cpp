#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "mpi/balance/rebalance.h"

namespace pbmpi::mpi {
namespace {

Placement moved(Placement placement, const std::vector<Move>& moves) {
  for (const Move& move : moves) placement[move.part] = move.to;
  return placement;
}

double max_load(const Placement& placement, const std::vector<double>& cost, int num_ranks) {
  const std::vector<double> loads = rank_loads(placement, cost, num_ranks);
  return *std::max_element(loads.begin(), loads.end());
}

int differences(const Placement& a, const Placement& b) {
  int count = 0;
  for (std::size_t world = 0; world < a.size(); ++world) count += a[world] != b[world] ? 1 : 0;
  return count;
}

TEST(Rebalance, leaves_equal_loads_alone) {
  const Placement placement = equal_placement(100, 4);
  const Rebalancing found = rebalance(placement, std::vector<double>(100, 0.1), 4, 1.1);
  EXPECT_TRUE(found.moves.empty());
}

TEST(Rebalance, leaves_loads_within_the_threshold_alone) {
  // Loads 54 and 46: max/avg 1.08.
  std::vector<double> cost(100, 1.0);
  Placement placement(100, 1);
  std::fill(placement.begin(), placement.begin() + 54, 0);
  EXPECT_TRUE(rebalance(placement, cost, 2, 1.1).moves.empty());
  // A threshold of 1.05 is exceeded; its lower half ends at 1.025, which 51 and 49 are the first to meet.
  EXPECT_EQ(rebalance(placement, cost, 2, 1.05).moves.size(), 3u);
}

TEST(Rebalance, moves_one_world_where_one_is_enough) {
  // Loads 10 + 2 against 2: the world of cost 5 evens them out.
  const std::vector<double> cost = {5, 5, 1, 1, 2};
  const Rebalancing found = rebalance(Placement{0, 0, 0, 0, 1}, cost, 2, 1.1);
  ASSERT_EQ(found.moves.size(), 1u);
  EXPECT_EQ(found.moves[0].part, 0);
  EXPECT_EQ(found.moves[0].to, 1);
  EXPECT_DOUBLE_EQ(found.imbalance_before, 12.0 / 7);
  EXPECT_DOUBLE_EQ(found.imbalance_after, 1.0);
}

TEST(Rebalance, swaps_where_no_single_world_can_move) {
  // Loads 16 and 8: moving 8 only swaps the roles, but exchanging 8 for 4 gives 12 and 12.
  const std::vector<double> cost = {8, 8, 4, 4};
  const Rebalancing found = rebalance(Placement{0, 0, 1, 1}, cost, 2, 1.1);
  EXPECT_EQ(found.moves.size(), 2u);
  EXPECT_EQ(max_load(moved({0, 0, 1, 1}, found.moves), cost, 2), 12);
}

TEST(Rebalance, gives_up_where_one_world_dominates) {
  const std::vector<double> cost = {100, 1, 1, 1};
  EXPECT_TRUE(rebalance(Placement{0, 1, 2, 3}, cost, 4, 1.1).moves.empty());
}

TEST(Rebalance, gives_up_where_idle_ranks_cannot_be_filled) {
  EXPECT_TRUE(rebalance(Placement{0, 1}, std::vector<double>{1, 1}, 4, 1.1).moves.empty());
}

TEST(Rebalance, moves_nothing_for_a_gain_that_is_not_worth_it) {
  // Max/avg 1.3 (130 against 70). The only world small enough to move lowers 130 by 2, less than the required
  // 5 %.
  const std::vector<double> cost = {128, 2, 70};
  EXPECT_TRUE(rebalance(Placement{0, 0, 1}, cost, 2, 1.1).moves.empty());
}

TEST(Rebalance, never_moves_with_an_infinite_threshold) {
  const std::vector<double> cost = {1, 1, 1, 1};
  const double never = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(rebalance(Placement{0, 0, 0, 0}, cost, 2, never).moves.empty());
}

TEST(Rebalance, is_never_worse_and_never_moves_a_world_to_where_it_is) {
  std::mt19937 random(7);
  std::uniform_int_distribution<int> whole(0, 1000);
  for (int trial = 0; trial < 500; ++trial) {
    const int num_ranks = 1 + trial % 6;
    std::vector<double> cost(1 + trial % 50);
    Placement placement(cost.size());
    for (std::size_t world = 0; world < cost.size(); ++world) {
      cost[world] = whole(random);
      placement[world] = whole(random) % num_ranks;
    }
    const Rebalancing found = rebalance(placement, cost, num_ranks, 1.1);
    const Placement after = moved(placement, found.moves);
    EXPECT_EQ(differences(placement, after), std::ssize(found.moves));
    if (found.moves.empty()) continue;
    // Integer costs: sums are exact. 5 % is the gain required at threshold 1.1, 1e-12 its rounding.
    EXPECT_LE(max_load(after, cost, num_ranks), max_load(placement, cost, num_ranks) * (0.95 + 1e-12));
    EXPECT_DOUBLE_EQ(found.imbalance_after, imbalance(rank_loads(after, cost, num_ranks)));
    const Rebalancing again = rebalance(placement, cost, num_ranks, 1.1);
    EXPECT_EQ(moved(placement, again.moves), after);
  }
}

TEST(Rebalance, evens_out_many_unequal_worlds_and_moves_fewer_than_a_fresh_placement) {
  std::mt19937 random(11);
  std::uniform_int_distribution<int> whole(50, 150);
  for (int trial = 0; trial < 50; ++trial) {
    std::vector<double> cost(100);
    for (double& c : cost) c = whole(random);
    for (int world = 0; world < 25; ++world)
      cost[world] *= 3;  // the first rank's worlds have become expensive
    const Placement placement = equal_placement(100, 4);
    const Rebalancing found = rebalance(placement, cost, 4, 1.1);
    EXPECT_GT(found.imbalance_before, 1.5);
    EXPECT_LE(found.imbalance_after, 1.05);  // the lower half of what 1.1 tolerates
    EXPECT_LT(std::ssize(found.moves), 25);
    EXPECT_LT(3 * std::ssize(found.moves), differences(placement, lpt_placement(cost, 4)));
  }
}

TEST(Rebalance, ends_where_sums_round) {
  // 0.1 is not a binary fraction: 30 worlds of equal cost on 4 ranks, distributed as unevenly as possible.
  const std::vector<double> cost(30, 0.1);
  const Rebalancing found = rebalance(Placement(30, 2), cost, 4, 1.0);
  EXPECT_EQ(found.moves.size(), 22u);  // 8 of 30 stay
  EXPECT_NEAR(found.imbalance_after, 8 / 7.5, 1e-12);
}

}  // namespace
}  // namespace pbmpi::mpi
