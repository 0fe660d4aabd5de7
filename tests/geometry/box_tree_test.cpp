#include "geometry/box_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/random_points.h"

namespace pbmpi::geometry {
namespace {

/// Boxes of sizes from 0.05 to 5 m in a cube.
std::vector<Box> boxes_in_cube(int count, double side) {
  std::vector<Box> boxes;
  boxes.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i)
    boxes.push_back(swept_box(point(i, 0, side), 0.05 * std::pow(10.0, 2 * number(i, 3)), {0, 0, 0}));
  return boxes;
}

std::vector<int> near(const BoxTree& tree, const Box& box) {
  std::vector<int> found;
  tree.for_each_near(box, [&](int item) { found.push_back(item); });
  std::ranges::sort(found);
  return found;
}

std::vector<int> brute_force(const std::vector<Box>& boxes, const Box& box) {
  std::vector<int> found;
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    if (boxes[i].overlaps(box)) found.push_back(static_cast<int>(i));
  }
  return found;
}

TEST(BoxTree, finds_what_brute_force_finds) {
  for (const int count : {0, 1, 7, 8, 9, 64, 65, 600, 5000}) {
    const std::vector<Box> boxes = boxes_in_cube(count, 20);
    BoxTree tree;
    tree.set(boxes);
    for (int query = 0; query < 40; ++query) {
      const Box box = swept_box(point(query, 10, 20), 0.3, point(query, 13, 2));
      EXPECT_EQ(near(tree, box), brute_force(boxes, box)) << count << ' ' << query;
    }
  }
}

// The order of the leaves is renewed in some of these steps.
TEST(BoxTree, follows_boxes_that_move) {
  std::vector<Box> boxes = boxes_in_cube(400, 20);
  BoxTree tree;
  tree.set(boxes);
  for (int step = 0; step < 60; ++step) {
    std::vector<int> moved;
    for (int i = step % 3; i < 400; i += step % 7 == 0 ? 2 : 40) moved.push_back(i);
    for (const int i : moved)
      boxes[static_cast<std::size_t>(i)] =
          swept_box(point(i, 20 + 3 * static_cast<std::uint64_t>(step), 20), 0.5, {0, 0, 0});
    tree.change(moved, boxes);
    for (int query = 0; query < 10; ++query) {
      const Box box = swept_box(point(query, 10, 20), 1, {0, 0, 0});
      ASSERT_EQ(near(tree, box), brute_force(boxes, box)) << step << ' ' << query;
    }
  }
}

TEST(BoxTree, stops_where_it_is_told) {
  const std::vector<Box> boxes = boxes_in_cube(300, 5);
  BoxTree tree;
  tree.set(boxes);
  const Box box = swept_box({2, 2, 2}, 1, {0, 0, 0});
  int num_asked = 0;
  EXPECT_TRUE(tree.any_near(box, [&](int) { return ++num_asked == 3; }));
  EXPECT_EQ(num_asked, 3);
  EXPECT_FALSE(tree.any_near(box, [](int) { return false; }));
}

TEST(BoxTree, takes_other_numbers_of_boxes) {
  BoxTree tree;
  for (const int count : {300, 20, 0, 500}) {
    const std::vector<Box> boxes = boxes_in_cube(count, 5);
    tree.set(boxes);
    const Box box = swept_box({2, 2, 2}, 1, {0, 0, 0});
    EXPECT_EQ(near(tree, box), brute_force(boxes, box));
  }
}

TEST(BoxTree, finds_endless_boxes_everywhere_and_others_that_are_not_finite_nowhere) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  std::vector<Box> boxes = boxes_in_cube(100, 1);
  boxes.push_back(swept_box({0, 0, 0}, std::numeric_limits<double>::infinity(), {0, 0, 0}));
  boxes.push_back(swept_box({nan, nan, nan}, 1, {0, 0, 0}));
  boxes.push_back({});
  BoxTree tree;
  tree.set(boxes);
  EXPECT_EQ(near(tree, swept_box({50, 1000, 0}, 1, {0, 0, 0})), std::vector<int>{100});
}

// Looking at all boxes for each of them, or along one axis only, would not end.
TEST(BoxTree, of_a_million_boxes_answers_a_million_times) {
  constexpr int side = 1000;
  std::vector<Box> boxes;
  boxes.reserve(side * side + 1);
  for (int i = 0; i < side * side; ++i)
    boxes.push_back(swept_box({0.0, i % side * 1.5, i / side * 1.5}, 0.8, {0, 0, 0}));  // NOLINT
  boxes.push_back(swept_box({0, 0, 0}, 2000, {0, 0, 0}));                               // around all
  BoxTree tree;
  tree.set(boxes);
  std::size_t num_found = 0;
  for (int i = 0; i < side * side; ++i)
    tree.for_each_near(boxes[static_cast<std::size_t>(i)], [&](int) { ++num_found; });
  const std::size_t with_neighbours = 9 * side * side - 12 * side + 4;
  EXPECT_EQ(num_found, with_neighbours + side * side);
}

// The ball is tested at 100 points of its path: wherever it is, the box holds it.
TEST(SweptBox, holds_the_ball_on_its_way) {
  for (int i = 0; i < 50; ++i) {
    const core::Vec3 centre = point(i, 0, 10), way = point(i, 3, 4) - core::Vec3(2, 2, 2);
    const Box box = swept_box(centre, 0.2, way);
    for (int share = 0; share <= 100; ++share) {
      const core::Vec3 at = centre + 0.01 * share * way;
      Box ball;
      for (std::size_t k = 0; k < 3; ++k) {
        ball.min[k] = at[static_cast<int>(k)] - 0.2;
        ball.max[k] = at[static_cast<int>(k)] + 0.2;
      }
      EXPECT_TRUE(box.holds(ball));
    }
  }
}

}  // namespace
}  // namespace pbmpi::geometry
