#include "app/common/quantities.h"

#include <gtest/gtest.h>

#include "core/error.h"

namespace pbmpi::app {
namespace {

TEST(Quantities, times_and_lengths_have_units) {
  EXPECT_DOUBLE_EQ(parse_time_s("3.33ms", "--budget"), 3.33e-3);  // one rounding of the product
  EXPECT_DOUBLE_EQ(parse_time_s("500us", "--budget"), 5e-4);
  EXPECT_EQ(parse_time_s("2s", "--budget"), 2);
  EXPECT_EQ(parse_time_or_seconds("2", "--budget"), 2);
  EXPECT_DOUBLE_EQ(parse_length_m("1cm", "--tolerance"), 0.01);
  for (const char* text : {"", "3", "ms", "-1ms", "0ms", "3.33 ms", "3mss", "nanms", "infms"}) {
    EXPECT_THROW(parse_time_s(text, "--budget"), core::InputError) << text;
  }
}

}  // namespace
}  // namespace pbmpi::app
