#include "mpi/balance/rebalance.h"

#include <gtest/gtest.h>

namespace pbmpi::mpi {
namespace {

const std::vector<double> even = {1, 1, 1, 1};
const Placement halves = {0, 0, 1, 1};

TEST(Rebalancer, waits_for_the_second_frame) {
  Rebalancer rebalancer(2, 1.1);
  const Placement lopsided = {0, 0, 0, 1};
  EXPECT_TRUE(rebalancer.frame_done(even, lopsided).moves.empty());
  EXPECT_EQ(rebalancer.frame_done(even, lopsided).moves.size(), 1u);
}

TEST(Rebalancer, ignores_a_single_disturbed_frame) {
  Rebalancer rebalancer(2, 1.1);
  const std::vector<double> disturbed = {9, 9, 1, 1};
  for (int frame = 0; frame < 20; ++frame) {
    EXPECT_TRUE(rebalancer.frame_done(frame % 3 == 0 ? disturbed : even, halves).moves.empty()) << frame;
  }
}

TEST(Rebalancer, follows_a_change_that_lasts) {
  Rebalancer rebalancer(2, 1.1);
  for (int frame = 0; frame < 5; ++frame) EXPECT_TRUE(rebalancer.frame_done(even, halves).moves.empty());
  const std::vector<double> dearer = {3, 2, 1, 1};
  EXPECT_TRUE(rebalancer.frame_done(dearer, halves).moves.empty());
  EXPECT_FALSE(rebalancer.frame_done(dearer, halves).moves.empty());
}

TEST(Rebalancer, rests_after_a_rebalance) {
  Rebalancer rebalancer(2, 1.1);
  const Placement lopsided = {0, 0, 0, 1};  // offered repeatedly, as if the moves had not helped
  int rebalances = 0;
  const int frames = 16;
  for (int frame = 0; frame < frames; ++frame) {
    if (!rebalancer.frame_done(even, lopsided).moves.empty()) {
      EXPECT_EQ((frame - (Rebalancer::min_frames - 1)) % (Rebalancer::cooldown + 1), 0) << frame;
      ++rebalances;
    }
  }
  EXPECT_EQ(rebalances, 3);  // frames 1, 6 and 11
}

TEST(Rebalancer, smooths_by_the_median_of_the_last_three_frames) {
  Rebalancer rebalancer(1, 1.1);
  EXPECT_TRUE(rebalancer.smoothed().empty());
  const Placement placement = {0};
  const std::vector<std::pair<double, double>> cost_and_median = {{5, 5}, {3, 3}, {4, 4},
                                                                  {9, 4}, {8, 8}, {1, 8}};
  for (const auto& [cost, median] : cost_and_median) {
    rebalancer.frame_done(std::vector<double>{cost}, placement);
    EXPECT_EQ(rebalancer.smoothed(), std::vector<double>{median});
  }
}

}  // namespace
}  // namespace pbmpi::mpi
