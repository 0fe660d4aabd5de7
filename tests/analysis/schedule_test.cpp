#include "analysis/schedule.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "core/random.h"

namespace pbmpi::analysis {
namespace {

TEST(Schedule, one_core_takes_the_sum_and_enough_cores_the_longest) {
  const std::vector<double> jobs = {3, 1, 4, 1, 5};
  EXPECT_DOUBLE_EQ(longest_first_makespan(jobs, 1), 14);
  EXPECT_DOUBLE_EQ(longest_first_makespan(jobs, 5), 5);
  EXPECT_DOUBLE_EQ(longest_first_makespan({}, 3), 0);
}

TEST(Schedule, packs_the_longest_first) {
  // Graham's example for which the rule is not optimal (6 would be): 3,3 | 2,2,2 against 3,2,2 | 3,2.
  EXPECT_DOUBLE_EQ(longest_first_makespan(std::vector<double>{2, 3, 2, 3, 2}, 2), 7);
}

TEST(Schedule, one_great_job_and_many_small_ones_need_two_cores) {
  std::vector<double> jobs(100, 0.01);
  jobs.push_back(1);
  EXPECT_EQ(fewest_cores(jobs, 0.001), 2);
}

TEST(Schedule, equal_jobs_need_a_core_each) {
  EXPECT_EQ(fewest_cores(std::vector<double>(10, 2.5), 0.05), 10);
  EXPECT_EQ(fewest_cores(std::vector<double>{2.5}, 0), 1);
  EXPECT_EQ(fewest_cores(std::vector<double>{0, 0}, 0), 0);
}

TEST(Schedule, a_tolerance_forgives_the_noise_of_measuring) {
  const std::vector<double> jobs = {1.0, 0.51, 0.51};
  EXPECT_EQ(fewest_cores(jobs, 0), 3);
  EXPECT_EQ(fewest_cores(jobs, 0.05), 2);
}

TEST(Schedule, the_fewest_cores_are_enough_and_one_less_is_not) {
  for (std::uint64_t trial = 0; trial < 200; ++trial) {
    std::vector<double> jobs;
    for (std::uint64_t job = 0; job < 3 + trial % 40; ++job) {
      jobs.push_back(core::to_unit(core::mix_key(7, trial, job)) + 1e-3);
    }
    const double longest = *std::max_element(jobs.begin(), jobs.end());
    const int cores = fewest_cores(jobs, 0);
    EXPECT_LE(longest_first_makespan(jobs, cores), longest);
    for (int less = 1; less < cores; ++less) EXPECT_GT(longest_first_makespan(jobs, less), longest);
  }
}

TEST(ParallelFrame, divides_the_solver_and_then_collision_detection) {
  const ParallelFrame frame{10, 2, 0.25, 0.5, 6};
  EXPECT_DOUBLE_EQ(frame.islands_parallel_s(), 5.5);  // 10 - 6 + 6/4
  EXPECT_DOUBLE_EQ(frame.spaces_parallel_s(), 4.5);   // 5.5 - 2 + 1
}

}  // namespace
}  // namespace pbmpi::analysis
