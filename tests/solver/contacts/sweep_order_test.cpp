#include "solver/contacts/sweep_order.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace pbmpi::solver {
namespace {

std::vector<int> shuffled(int num_colors, std::uint64_t key) {
  SweepOrder order;
  order.shuffle(num_colors, key);
  return {order.colors().begin(), order.colors().end()};
}

TEST(SweepOrder, every_colour_and_point_comes_once) {
  for (std::uint64_t key = 0; key < 20; ++key) {
    SweepOrder order;
    order.shuffle(100, key);
    std::vector<int> colors(order.colors().begin(), order.colors().end());
    std::ranges::sort(colors);
    for (int i = 0; i < 100; ++i) EXPECT_EQ(colors[static_cast<std::size_t>(i)], i);
    SweepOrder::Points points = order.points();
    std::ranges::sort(points);
    EXPECT_EQ(points, (SweepOrder::Points{0, 1, 2, 3}));
  }
}

TEST(SweepOrder, colours_come_in_the_same_order_however_many_there_are) {
  for (std::uint64_t key = 0; key < 20; ++key) {
    const std::vector<int> many = shuffled(40, key);
    for (int count = 0; count < 40; ++count) {
      std::vector<int> some = many;
      std::erase_if(some, [&](int color) { return color >= count; });
      EXPECT_EQ(shuffled(count, key), some);
    }
  }
}

TEST(SweepOrder, keys_give_different_orders) {
  std::set<std::vector<int>> orders;
  std::set<SweepOrder::Points> points;
  SweepOrder order;
  for (std::uint64_t key = 0; key < 500; ++key) {
    orders.insert(shuffled(12, key));
    order.shuffle(12, key);
    points.insert(order.points());
  }
  EXPECT_EQ(orders.size(), 500u);
  EXPECT_EQ(points.size(), 24u) << "all permutations of four points";
}

TEST(SweepOrder, without_a_key_it_ascends) {
  SweepOrder order;
  order.shuffle(7, 3);
  order.sort(4);
  EXPECT_EQ(std::vector<int>(order.colors().begin(), order.colors().end()), (std::vector<int>{0, 1, 2, 3}));
  EXPECT_EQ(order.points(), (SweepOrder::Points{0, 1, 2, 3}));
}

}  // namespace
}  // namespace pbmpi::solver
