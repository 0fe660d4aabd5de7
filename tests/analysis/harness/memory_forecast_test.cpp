#include "analysis/harness/memory_forecast.h"

#include <gtest/gtest.h>

namespace pbmpi::analysis {
namespace {

TEST(MemoryForecast, of_a_rank_does_not_grow_with_ranks_or_results_that_root_alone_holds) {
  HarnessCosts costs;
  costs.base_bytes = 30e6;
  costs.body_bytes = 1000;
  const HarnessLoad load{.num_ranks = 1024, .num_worlds = 102400, .bodies_each = 37};
  const MemoryForecast before =
      memory_forecast(load, costs, GatherShape::linear(1024), EndOfRun::on_every_rank, 1000);
  const MemoryForecast after = memory_forecast(load, costs, {}, EndOfRun::on_root, 1000);
  EXPECT_GT(before.any_rank - after.any_rank, 1024.0 * 1000 * 8) << "times of 1,024 ranks in 1,000 frames";
  // 36 bytes of the table for each world of the run; the bodies, message and result of each of the 100 own
  // worlds; and two pieces of what other ranks hand on.
  EXPECT_DOUBLE_EQ(after.any_rank, 30e6 + 36.0 * 102400 + 100 * (37 * 1000.0 + 2080 + 368) + 2.0 * (1 << 20));
  EXPECT_DOUBLE_EQ(after.row_writer - after.any_rank, 104.0 * 37 * 102400);
  EXPECT_GT(after.root, after.any_rank);
}

}  // namespace
}  // namespace pbmpi::analysis
