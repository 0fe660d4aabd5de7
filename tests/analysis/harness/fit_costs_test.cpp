#include "analysis/harness/fit_costs.h"

#include <gtest/gtest.h>

#include <vector>

namespace pbmpi::analysis {
namespace {

// Times that follow the formulas give their costs back, up to the rounding of the fit: 1e-6 of each.
TEST(FitCosts, finds_the_costs_of_which_times_are_made) {
  std::vector<TimedCase> cases;
  for (const std::int64_t worlds : {1, 10, 100}) {
    for (const std::int64_t bodies : {1, 40}) {
      for (const std::int64_t steps : {1, 8}) {
        cases.push_back({TimedPart::frame, 1, worlds, bodies, steps, 0,
                         2e-6 + static_cast<double>(worlds) * (1e-7 + 3e-9 * static_cast<double>(steps) +
                                                               5e-9 * static_cast<double>(bodies))});
      }
      cases.push_back({TimedPart::unpack, 64, worlds, bodies, 0, 0,
                       static_cast<double>(worlds) * (2e-8 + 4e-9 * static_cast<double>(bodies))});
    }
  }
  for (const std::int64_t bytes : {8, 1024, 1048576})
    cases.push_back({TimedPart::message, 2, 0, 0, 0, bytes, 3e-6 + 2e-10 * static_cast<double>(bytes)});
  cases.push_back({TimedPart::send, 2, 0, 0, 0, 8, 4e-7});
  cases.push_back({TimedPart::receive, 2, 0, 0, 0, 8, 6e-7});
  const HarnessCosts costs = fit_costs(cases);
  const auto near = [](double found, double expected) { EXPECT_NEAR(found, expected, 1e-6 * expected); };
  near(costs.frame_s, 2e-6);
  near(costs.world_frame_s, 1e-7);
  near(costs.world_step_s, 3e-9);
  near(costs.body_frame_s, 5e-9);
  near(costs.unpack_world_s, 2e-8);
  near(costs.unpack_body_s, 4e-9);
  near(costs.link.byte_s, 2e-10);
  near(costs.link.overhead_s, 4e-7);
  near(costs.link.latency_s, 3e-6 - 8e-7);
  near(costs.link.gap_s, 6e-7);
  EXPECT_EQ(costs.hash_world_s, 0) << "was not timed";
}

TEST(FitCosts, has_no_negative_cost) {
  // The time falls as ranks are added, as if a rank gave time back.
  const std::vector<TimedCase> cases = {{TimedPart::balance, 10, 100, 0, 0, 0, 1e-3},
                                        {TimedPart::balance, 1000, 100, 0, 0, 0, 0.9e-3}};
  const HarnessCosts costs = fit_costs(cases);
  EXPECT_EQ(costs.balance_rank_s, 0);
  EXPECT_NEAR(costs.balance_world_s, 0.95e-5, 0.05e-5);
}

}  // namespace
}  // namespace pbmpi::analysis
