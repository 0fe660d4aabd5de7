#include <gtest/gtest.h>

#include <cmath>

#include "app/pbreport/paper/complexity.h"

namespace pbmpi::app {
namespace {

IslandWork islands(const std::vector<SolvedIsland>& step) {
  IslandWork work;
  work.islands = {step};
  return work;
}

TEST(Growth, finds_the_exponent_of_a_power_law) {
  std::vector<SolvedIsland> step;
  for (const int rows : {100, 150, 400, 3000}) step.push_back({rows, 3e-9 * std::pow(rows, 2.5)});
  const auto growth = growth_of({islands(step), islands({{200, 3e-9 * std::pow(200, 2.5)}})});
  ASSERT_TRUE(growth);
  EXPECT_NEAR(growth->exponent, 2.5, 1e-12);  // rounding
  EXPECT_EQ(growth->num_islands, 5);
  EXPECT_EQ(growth->least_rows, 100);
  EXPECT_EQ(growth->most_rows, 3000);
}

TEST(Growth, leaves_small_islands_out_and_those_too_short_for_the_clock) {
  const auto growth = growth_of({islands({{99, 1}, {100, 1e-3}, {200, 0}, {800, 8e-3}})});
  ASSERT_TRUE(growth);
  EXPECT_NEAR(growth->exponent, 1, 1e-12);  // rounding
  EXPECT_EQ(growth->num_islands, 2);
}

TEST(Growth, is_not_told_by_islands_of_one_size) {
  EXPECT_FALSE(growth_of({islands({{100, 1e-3}, {399, 4e-3}})}));
  EXPECT_TRUE(growth_of({islands({{100, 1e-3}, {400, 4e-3}})}));
  EXPECT_FALSE(growth_of({}));
}

TEST(Growth, time_of_a_row_is_over_all_islands) {
  EXPECT_DOUBLE_EQ(time_of_a_row(islands({{100, 1e-3}, {300, 3e-3}, {100, 1e-3}})), 1e-5);
  EXPECT_EQ(time_of_a_row(IslandWork()), 0);
}

}  // namespace
}  // namespace pbmpi::app
