#include "analysis/harness/frame_traffic.h"

#include <gtest/gtest.h>

namespace pbmpi::analysis {
namespace {

TEST(FrameTraffic, of_two_ranks_is_one_message_of_poses_two_of_the_agreement_and_one_of_the_verdict) {
  // Rank 1 has 50 of 100 worlds of 37 bodies: 50 x (1 + 7 x 37) numbers of 8 bytes.
  const FrameTraffic traffic = frame_traffic({.num_ranks = 2, .num_worlds = 100, .bodies_each = 37});
  EXPECT_EQ(traffic.gather.messages, 1);
  EXPECT_EQ(traffic.gather.bytes, 50 * 260 * 8);
  EXPECT_EQ(traffic.into_root.bytes, traffic.gather.bytes);
  EXPECT_EQ(traffic.agreement.messages, 2);
  EXPECT_EQ(traffic.agreement.bytes, 96);
  EXPECT_EQ(traffic.verdict.messages, 1);
  EXPECT_EQ(traffic.verdict.bytes, 32);
  EXPECT_EQ(traffic.all().messages, 4);
}

TEST(FrameTraffic, of_one_rank_is_none) {
  const FrameTraffic traffic = frame_traffic({.num_ranks = 1, .num_worlds = 100, .bodies_each = 37});
  EXPECT_EQ(traffic.all().messages, 0);
  EXPECT_EQ(traffic.all().bytes, 0);
}

TEST(FrameTraffic, of_four_ranks_in_a_binomial_tree_passes_one_share_on) {
  // 8 worlds of 1 body, 2 a rank: shares of 128 bytes. 1 -> 0, 3 -> 2, 2 -> 0 with the share of 3.
  const HarnessLoad load{.num_ranks = 4, .num_worlds = 8, .bodies_each = 1};
  const FrameTraffic traffic = frame_traffic(load, {.radix = 2, .piece_bytes = 200});
  EXPECT_EQ(traffic.gather.bytes, 4 * 128);
  EXPECT_EQ(traffic.gather.messages, 1 + 1 + 2) << "256 bytes are two pieces of 200 at most";
  EXPECT_EQ(traffic.into_root.bytes, 3 * 128);
  EXPECT_EQ(traffic.into_root.messages, 3);
  EXPECT_EQ(traffic.busiest_rank.bytes, 256);
}

TEST(FrameTraffic, of_ranks_without_worlds_is_no_message) {
  const FrameTraffic traffic = frame_traffic({.num_ranks = 8, .num_worlds = 3, .bodies_each = 2});
  EXPECT_EQ(traffic.gather.messages, 2) << "ranks 1 and 2 have a world each";
}

TEST(FrameTraffic, brings_the_same_bytes_into_root_by_every_tree_and_fewer_messages_by_a_deeper_one) {
  const HarnessLoad load{.num_ranks = 1024, .num_worlds = 5000, .bodies_each = 3};
  const FrameTraffic linear = frame_traffic(load, GatherShape::linear(1024)), tree = frame_traffic(load);
  EXPECT_EQ(linear.into_root.bytes, tree.into_root.bytes);
  EXPECT_EQ(linear.into_root.messages, 1023);
  EXPECT_EQ(tree.into_root.messages, 62);
  EXPECT_EQ(linear.busiest_rank.bytes, 5 * 176);
  EXPECT_EQ(tree.busiest_rank.bytes, 32 * 5 * 176);
}

// Open MPI 4.1.4's own count (pml monitoring) of an allreduce of 6 numbers is 2, 4 and 384 messages.
TEST(FrameTraffic, counts_an_allreduce_as_open_mpi_does) {
  EXPECT_EQ(messages_of_allreduce(1), 0);
  EXPECT_EQ(messages_of_allreduce(2), 2);
  EXPECT_EQ(messages_of_allreduce(3), 4);
  EXPECT_EQ(messages_of_allreduce(64), 384);
  EXPECT_EQ(rounds_of_allreduce(64), 6);
  EXPECT_EQ(rounds_of_allreduce(65), 8);
}

}  // namespace
}  // namespace pbmpi::analysis
