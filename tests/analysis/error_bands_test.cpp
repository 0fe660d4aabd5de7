#include "analysis/error_bands.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

namespace pbmpi::analysis {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double inf = std::numeric_limits<double>::infinity();

TEST(ErrorBands, positions_fall_into_the_categories_of_the_paper) {
  EXPECT_EQ(position_band(0), 0);
  EXPECT_EQ(position_band(0.0099), 0);
  EXPECT_EQ(position_band(0.01), 1);
  EXPECT_EQ(position_band(0.05), 1);
  EXPECT_EQ(position_band(0.5), 2);
  EXPECT_EQ(position_band(1.5), 3);
  EXPECT_EQ(position_band(nan), 4);
  EXPECT_EQ(position_band(inf), 4);
}

TEST(ErrorBands, orientations_fall_into_shares_of_a_full_turn) {
  const double degree = std::numbers::pi / 180;
  EXPECT_EQ(orientation_band(17.9 * degree), 0);
  EXPECT_EQ(orientation_band(30 * degree), 1);
  EXPECT_EQ(orientation_band(91 * degree), 2);
  EXPECT_EQ(orientation_band(std::numbers::pi), 2) << "half a turn is the most there is, and not beyond 50 %";
  EXPECT_EQ(orientation_band(200 * degree), 3);
  EXPECT_EQ(orientation_band(nan), 4);
}

TEST(ErrorBands, every_error_is_in_one_category_and_only_finite_ones_in_the_numbers) {
  const std::vector<double> errors = {0, 0.003, 0.004, 2, nan, -inf};
  const ErrorSummary summary = summarize_positions(errors);
  EXPECT_EQ(summary.count, 6);
  EXPECT_EQ(summary.bands, (BandCounts{3, 0, 0, 1, 2}));
  EXPECT_EQ(std::accumulate(summary.bands.begin(), summary.bands.end(), std::int64_t{0}), summary.count);
  EXPECT_EQ(summary.max, 2);
  // Both sides are one square root of sums of four exact products: equal to the last digits.
  EXPECT_DOUBLE_EQ(summary.rms, std::sqrt((0.003 * 0.003 + 0.004 * 0.004 + 4) / 4));
}

TEST(ErrorBands, p99_is_interpolated_between_order_statistics) {
  std::vector<double> errors(101);
  std::iota(errors.begin(), errors.end(), 0.0);
  EXPECT_DOUBLE_EQ(summarize_positions(errors).p99, 99);  // rounding of 0.99 x 100 alone
}

TEST(ErrorBands, nothing_but_nan_has_counts_and_no_numbers) {
  const ErrorSummary summary = summarize_orientations(std::vector<double>{nan, nan});
  EXPECT_EQ(summary.bands, (BandCounts{0, 0, 0, 0, 2}));
  EXPECT_EQ(summary.max, 0);
}

}  // namespace
}  // namespace pbmpi::analysis
