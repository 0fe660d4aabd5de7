#include "solver/lanes/lanes.h"

#include <gtest/gtest.h>

#include <limits>

namespace pbmpi::solver {
namespace {

template <class T>
class LaneBits : public testing::Test {};

using Widths =
    testing::Types<LaneTraits<float, 1>, LaneTraits<float, 4>, LaneTraits<double, 1>, LaneTraits<double, 2>>;
TYPED_TEST_SUITE(LaneBits, Widths);

TYPED_TEST(LaneBits, are_set_where_a_lane_is_not_0) {
  using T = TypeParam;
  for (unsigned expected = 0; expected < 1u << T::num_lanes; ++expected) {
    typename T::V flags = T::broadcast(0);
    for (int lane = 0; lane < T::num_lanes; ++lane) T::set(flags, lane, (expected >> lane & 1) != 0 ? 1 : 0);
    EXPECT_EQ(T::bits(flags), expected);
    EXPECT_EQ(T::any(flags), expected != 0);
  }
}

TYPED_TEST(LaneBits, are_set_for_what_is_no_number_and_not_for_a_zero_of_either_sign) {
  using T = TypeParam;
  using Limits = std::numeric_limits<typename T::Scalar>;
  EXPECT_EQ(T::bits(T::broadcast(Limits::quiet_NaN())), (1u << T::num_lanes) - 1);
  EXPECT_EQ(T::bits(T::broadcast(-Limits::denorm_min())), (1u << T::num_lanes) - 1);
  EXPECT_EQ(T::bits(T::broadcast(0) * T::broadcast(-1)), 0u);
}

}  // namespace
}  // namespace pbmpi::solver
