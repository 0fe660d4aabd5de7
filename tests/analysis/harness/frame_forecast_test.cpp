#include "analysis/harness/frame_forecast.h"

#include <gtest/gtest.h>

#include <cmath>

namespace pbmpi::analysis {
namespace {

// Times are sums and products of a few numbers; 1e-15 s is far above their rounding, and far below any term.
constexpr double rounding_s = 1e-15;

TEST(FrameForecast, of_a_flat_gather_is_the_messages_that_root_takes_one_after_the_other) {
  const LinkCosts link{.latency_s = 2e-6, .overhead_s = 1e-6, .gap_s = 0.5e-6, .byte_s = 1e-9};
  // 4 worlds of 1 body on 4 ranks: three messages of 64 bytes, all sent at 0 and received after o + L.
  const HarnessLoad load{.num_ranks = 4, .num_worlds = 4, .bodies_each = 1};
  const double message_s = 1e-6 + 64e-9;
  EXPECT_NEAR(gather_s(load, link, GatherShape::linear(4)), 1e-6 + 2e-6 + 3 * message_s, rounding_s);
}

TEST(FrameForecast, of_a_binomial_gather_follows_the_longest_way) {
  const LinkCosts link{.latency_s = 2e-6, .overhead_s = 1e-6, .gap_s = 0, .byte_s = 1e-9};
  const HarnessLoad load{.num_ranks = 4, .num_worlds = 4, .bodies_each = 1};
  // 3 sends to 2, which has the whole message after o + L + o + 64 G and hands on two shares for another o;
  // by then root has the message of 1.
  const double at_2 = 1e-6 + 2e-6 + 1e-6 + 64e-9;
  EXPECT_NEAR(gather_s(load, link, {.radix = 2, .piece_bytes = 1 << 20}), at_2 + 1e-6 + 2e-6 + 1e-6 + 128e-9,
              rounding_s);
}

TEST(FrameForecast, hands_pieces_on_while_others_arrive) {
  // Long streams over 3 levels: root's own bytes decide, not their number of levels.
  const LinkCosts link{.latency_s = 1e-6, .overhead_s = 1e-6, .gap_s = 1e-6, .byte_s = 1e-9};
  const HarnessLoad load{.num_ranks = 8, .num_worlds = 8000, .bodies_each = 37};
  const double bytes = 7000.0 * 260 * 8;
  const double seconds = gather_s(load, link, {.radix = 2, .piece_bytes = 1 << 16});
  EXPECT_GT(seconds, bytes * 1e-9);
  EXPECT_LT(seconds, 1.3 * bytes * 1e-9) << "a quarter of the stream would wait at each level otherwise";
}

TEST(FrameForecast, counts_every_part_once) {
  HarnessCosts costs;
  costs.link = {.latency_s = 1e-6, .overhead_s = 1e-6, .gap_s = 0, .byte_s = 0};
  costs.frame_s = 10e-6;
  costs.world_frame_s = 2e-6;
  costs.world_step_s = 1e-7;
  costs.body_frame_s = 1e-8;
  costs.unpack_world_s = 1e-7;
  costs.unpack_body_s = 1e-8;
  costs.balance_world_s = 3e-7;
  costs.balance_rank_s = 1e-6;
  HarnessLoad load{.num_ranks = 2, .num_worlds = 10, .bodies_each = 4, .steps_per_frame = 3, .step_s = 1e-4};
  const FrameForecast frame = frame_forecast(load, costs);
  EXPECT_NEAR(frame[FramePart::step], 5 * 3 * 1e-4, rounding_s);
  EXPECT_NEAR(frame[FramePart::harness], 10e-6 + 5 * (2e-6 + 3e-7 + 4e-8), rounding_s);
  EXPECT_NEAR(frame[FramePart::agreement], 3e-6, rounding_s);
  EXPECT_NEAR(frame[FramePart::gather], 3e-6, rounding_s);
  EXPECT_NEAR(frame[FramePart::unpack], 5 * (1e-7 + 4e-8), rounding_s);
  EXPECT_NEAR(frame[FramePart::balance], 10 * 3e-7 + 2e-6, rounding_s);
  EXPECT_NEAR(frame[FramePart::verdict], 3e-6, rounding_s);
  EXPECT_EQ(frame.wall(), FramePart::harness);
  load.num_ranks = 1;
  EXPECT_NEAR(frame_forecast(load, costs).total_s(), 10 * 3e-4 + 10e-6 + 10 * (2e-6 + 3e-7 + 4e-8),
              rounding_s);
}

TEST(FrameForecast, lets_the_slowest_of_many_ranks_decide) {
  const HarnessLoad load{.num_ranks = 1024,
                         .num_worlds = 4096,
                         .bodies_each = 1,
                         .steps_per_frame = 1,
                         .step_s = 1e-3,
                         .variation = 0.1};
  EXPECT_NEAR(frame_forecast(load, {})[FramePart::step],
              4e-3 * (1 + 0.1 * std::sqrt(2 * std::log(1024.0) / 4)), 1e-12);
}

}  // namespace
}  // namespace pbmpi::analysis
