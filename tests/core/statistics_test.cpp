#include "core/statistics.h"

#include <cmath>
#include <numeric>
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

TEST(MedianInterval, is_the_narrowest_that_is_sure_enough) {
  // Probability of at most k heads in n tosses, n = 5: 1, 6; n = 6: 1, 7; n = 9: 1, 10, 46 of 2^n.
  const auto expect = [](const Interval& found, double low, double high, double confidence) {
    EXPECT_EQ(found.low, low);
    EXPECT_EQ(found.high, high);
    EXPECT_DOUBLE_EQ(found.confidence, confidence);
  };
  expect(median_interval({5, 3, 1, 2, 4}, 0.95), 1, 5, 1 - 2. / 32);
  expect(median_interval({5, 3, 1, 2, 4}, 0.5), 2, 4, 1 - 12. / 32);
  expect(median_interval({6, 5, 3, 1, 2, 4}, 0.95), 1, 6, 1 - 2. / 64);
  expect(median_interval({9, 8, 7, 6, 5, 4, 3, 2, 1}, 0.95), 2, 8, 1 - 20. / 512);
  expect(median_interval({9, 8, 7, 6, 5, 4, 3, 2, 1}, 0.8), 3, 7, 1 - 92. / 512);
  expect(median_interval({7}, 0.95), 7, 7, 0);
  expect(median_interval({}, 0.95), 0, 0, 0);
}

/// Computed with fractions of whole numbers; 2^-2000 is below every double.
TEST(MedianInterval, is_that_of_long_samples_too) {
  std::vector<double> values(2000);
  std::iota(values.begin(), values.end(), 0);
  const Interval found = median_interval(values, 0.95);
  EXPECT_EQ(found.low, 955);
  EXPECT_EQ(found.high, 1044);
  EXPECT_NEAR(found.confidence, 0.9534471795082162, 1e-12);
}

TEST(HarmonicMean, is_the_rate_over_equal_work) {
  EXPECT_DOUBLE_EQ(harmonic_mean(std::vector<double>{40, 60}), 48);
  EXPECT_EQ(harmonic_mean({}), 0);
  EXPECT_EQ(harmonic_mean(std::vector<double>{1, 0}), 0);
  EXPECT_EQ(harmonic_mean(std::vector<double>{1, NAN}), 0);
}

}  // namespace
}  // namespace pbmpi::core
