#include "mpi/balance/partition.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <random>

namespace pbmpi::mpi {
namespace {

double makespan(const Placement& placement, const std::vector<double>& cost, int num_ranks) {
  const std::vector<double> loads = rank_loads(placement, cost, num_ranks);
  return *std::max_element(loads.begin(), loads.end());
}

/// The least makespan of all placements, found by trying them all.
double best_makespan(const std::vector<double>& cost, int num_ranks) {
  Placement placement(cost.size(), 0);
  double best = std::numeric_limits<double>::infinity();
  const std::function<void(std::size_t)> place = [&](std::size_t world) {
    if (world == cost.size()) {
      best = std::min(best, makespan(placement, cost, num_ranks));
      return;
    }
    for (placement[world] = 0; placement[world] < num_ranks; ++placement[world]) place(world + 1);
  };
  place(0);
  return best;
}

/// Integer costs, so that sums are exact and comparisons need no tolerance.
std::vector<double> random_costs(std::mt19937& random, int count) {
  std::uniform_int_distribution<int> whole(1, 1000);
  std::vector<double> cost(count);
  for (double& c : cost) c = whole(random);
  return cost;
}

TEST(EqualPlacement, gives_each_world_to_exactly_one_rank_in_contiguous_blocks) {
  for (int num_ranks = 1; num_ranks <= 9; ++num_ranks) {
    for (int num_worlds = 0; num_worlds <= 40; ++num_worlds) {
      const Placement placement = equal_placement(num_worlds, num_ranks);
      ASSERT_EQ(std::ssize(placement), num_worlds);
      EXPECT_TRUE(std::is_sorted(placement.begin(), placement.end()));
      for (int rank = 0; rank < num_ranks; ++rank) {
        const auto count = std::count(placement.begin(), placement.end(), rank);
        EXPECT_TRUE(count == num_worlds / num_ranks || count == (num_worlds + num_ranks - 1) / num_ranks);
      }
    }
  }
}

TEST(LptPlacement, stays_within_grahams_bound_of_the_best_placement) {
  std::mt19937 random(1);
  for (int trial = 0; trial < 60; ++trial) {
    const int num_ranks = 1 + trial % 3;
    const std::vector<double> cost = random_costs(random, 1 + trial % 8);
    const Placement placement = lpt_placement(cost, num_ranks);
    ASSERT_EQ(placement.size(), cost.size());
    for (const int rank : placement) EXPECT_TRUE(rank >= 0 && rank < num_ranks);
    const double bound = 4.0 / 3 - 1.0 / (3 * num_ranks);
    // 1e-12: the bound itself is rounded
    EXPECT_LE(makespan(placement, cost, num_ranks), bound * best_makespan(cost, num_ranks) * (1 + 1e-12));
  }
}

TEST(LptPlacement, meets_grahams_worst_case_exactly) {
  // Two ranks, 3 3 2 2 2: the best placement needs 6, LPT 7 = 6 (4/3 - 1/6).
  const std::vector<double> cost = {3, 3, 2, 2, 2};
  EXPECT_EQ(best_makespan(cost, 2), 6);
  EXPECT_EQ(makespan(lpt_placement(cost, 2), cost, 2), 7);
}

TEST(LptPlacement, breaks_ties_by_the_lower_world_and_the_lower_rank) {
  EXPECT_EQ(lpt_placement(std::vector<double>(5, 1.0), 3), (Placement{0, 1, 2, 0, 1}));
}

TEST(LptPlacement, refuses_costs_that_are_not_times) {
  EXPECT_THROW(lpt_placement(std::vector<double>{1, std::nan("")}, 2), std::logic_error);
  EXPECT_THROW(lpt_placement(std::vector<double>{-1}, 2), std::logic_error);
}

TEST(Imbalance, is_the_largest_over_the_average_load) {
  EXPECT_EQ(imbalance(std::vector<double>{3, 1}), 1.5);
  EXPECT_EQ(imbalance(std::vector<double>{0, 0}), 1.0);
}

}  // namespace
}  // namespace pbmpi::mpi
