#include "core/text.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <cstdlib>

namespace pbmpi::core {
namespace {

TEST(NumberText, has_as_many_digits_as_it_takes) {
  EXPECT_EQ(number_text(0.1), "0.1");
  EXPECT_EQ(number_text(std::int64_t{-12}), "-12");
  const double third = 1.0 / 3;
  EXPECT_EQ(std::strtod(number_text(third).c_str(), nullptr), third);
}

}  // namespace
}  // namespace pbmpi::core
