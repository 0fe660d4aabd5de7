#include "core/elementary.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <numbers>

#include "core/random.h"

namespace pbmpi::core {
namespace {

constexpr int num_samples = 200000;

/// A number between -most and most.
double sample(int index, int which, double most) {
  return most *
         (2 * to_unit(mix_key(1, static_cast<std::uint64_t>(index), static_cast<std::uint64_t>(which))) - 1);
}

/// The error of `value` in units in the last place of the exact value.
double units_off(double value, long double exact) {
  const double rounded = std::abs(static_cast<double>(exact));
  const double unit = std::nextafter(rounded, std::numeric_limits<double>::infinity()) - rounded;
  return static_cast<double>(std::abs(value - exact)) / unit;
}

std::uint64_t bits(double value) {
  std::uint64_t result = 0;
  std::memcpy(&result, &value, sizeof result);
  return result;
}

TEST(Elementary, sine_and_cosine_are_within_two_units_in_the_last_place) {
  for (const double most : {0.01, 1.0, 10.0, 1e5}) {
    double worst = 0;
    for (int i = 0; i < num_samples; ++i) {
      const double angle = sample(i, 0, most);
      worst = std::fmax(worst, units_off(sine(angle), std::sin(static_cast<long double>(angle))));
      worst = std::fmax(worst, units_off(cosine(angle), std::cos(static_cast<long double>(angle))));
    }
    EXPECT_LT(worst, 2) << "up to " << most;
  }
}

TEST(Elementary, exponential_is_within_two_units_in_the_last_place) {
  for (const double most : {0.01, 1.0, 700.0}) {
    double worst = 0;
    for (int i = 0; i < num_samples; ++i) {
      const double x = sample(i, 1, most);
      worst = std::fmax(worst, units_off(exponential(x), std::exp(static_cast<long double>(x))));
    }
    EXPECT_LT(worst, 2) << "up to " << most;
  }
}

TEST(Elementary, angles_of_directions_are_within_eight_units_in_the_last_place) {
  double worst = 0;
  for (int i = 0; i < num_samples; ++i) {
    const double x = sample(i, 2, 3), y = sample(i, 3, 3);
    worst = std::fmax(worst, units_off(angle_of(y, x),
                                       std::atan2(static_cast<long double>(y), static_cast<long double>(x))));
  }
  EXPECT_LT(worst, 8);
}

TEST(Elementary, values_that_everybody_knows_are_exact) {
  EXPECT_EQ(sine(0), 0);
  EXPECT_EQ(cosine(0), 1);
  EXPECT_EQ(sine(std::numbers::pi / 2), 1);
  EXPECT_EQ(cosine(std::numbers::pi), -1);
  EXPECT_EQ(exponential(0), 1);
  EXPECT_EQ(angle_of(0, 1), 0);
  EXPECT_EQ(angle_of(0, -1), std::numbers::pi);
  EXPECT_NEAR(angle_of(1, 0), std::numbers::pi / 2, 1e-15);
  EXPECT_NEAR(angle_of(-1e200, -1e200), -3 * std::numbers::pi / 4, 1e-15);
}

TEST(Elementary, ends_of_the_range_have_values) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(std::isnan(sine(infinity)));
  EXPECT_TRUE(std::isnan(cosine(-infinity)));
  EXPECT_LE(std::abs(sine(1e300)), 1);
  EXPECT_EQ(exponential(-infinity), 0);
  EXPECT_EQ(exponential(1000), infinity);
  EXPECT_EQ(exponential(-1000), 0);
  EXPECT_TRUE(std::isnan(exponential(std::nan(""))));
  EXPECT_EQ(angle_of(0, 0), 0);
  EXPECT_NEAR(angle_of(infinity, -infinity), 3 * std::numbers::pi / 4, 1e-15);
  EXPECT_TRUE(std::isnan(angle_of(std::nan(""), 1)));
}

TEST(Elementary, bits_are_those_of_every_other_machine) {
  EXPECT_EQ(bits(sine(0.7)), 0x3fe49d6e694619b8u);
  EXPECT_EQ(bits(cosine(2.5)), 0xbfe9a2f7ef858b7du);
  EXPECT_EQ(bits(exponential(-0.003)), 0x3fefe775f8c4dce8u);
  EXPECT_EQ(bits(angle_of(0.3, -1.1)), 0x400700b29327680fu);
}

}  // namespace
}  // namespace pbmpi::core
