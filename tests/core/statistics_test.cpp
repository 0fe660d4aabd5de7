#include "core/statistics.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace pbmpi::core {
namespace {

TEST(Summarize, gives_the_moments_of_a_sample) {
  const std::vector<double> values = {2, 4, 4, 4, 5, 5, 7, 9};
  const Summary summary = summarize(values);
  EXPECT_EQ(summary.min, 2);
  EXPECT_EQ(summary.max, 9);
  EXPECT_EQ(summary.mean, 5);
  EXPECT_EQ(summary.stddev, 2);  // of the population; divided by n - 1 it would be 2.138
}

TEST(Summarize, is_zero_for_an_empty_sample) {
  const Summary summary = summarize({});
  EXPECT_EQ(summary.max, 0);
  EXPECT_EQ(summary.stddev, 0);
}

TEST(Quantile, interpolates_between_order_statistics) {
  const std::vector<double> values = {40, 10, 30, 20};
  EXPECT_EQ(quantile(values, 0), 10);
  EXPECT_EQ(quantile(values, 1), 40);
  EXPECT_EQ(quantile(values, 0.5), 25);
  EXPECT_DOUBLE_EQ(quantile(values, 0.9), 37);
  EXPECT_EQ(quantile({7}, 0.99), 7);
  EXPECT_EQ(quantile({}, 0.5), 0);
}

TEST(HarmonicMean, is_the_rate_over_equal_work) {
  EXPECT_DOUBLE_EQ(harmonic_mean(std::vector<double>{40, 60}), 48);
  EXPECT_EQ(harmonic_mean({}), 0);
  EXPECT_EQ(harmonic_mean(std::vector<double>{1, 0}), 0);
  EXPECT_EQ(harmonic_mean(std::vector<double>{1, NAN}), 0);
}

}  // namespace
}  // namespace pbmpi::core
