#include "geometry/swept_balls.h"

#include <gtest/gtest.h>

#include <numeric>

#include <algorithm>
#include <limits>

#include "geometry/random_points.h"

namespace pbmpi::geometry {
namespace {

/// Ascending.
std::vector<int> near(SweptBalls& balls, const Box& box, int but_family = -1) {
  balls.finish();
  std::vector<int> found;
  balls.for_each_near(box, but_family, [&](int index) { found.push_back(index); });
  std::ranges::sort(found);
  return found;
}

// The ball is tested at 100 points of its path: wherever it overlaps the box, it must be found.
TEST(SweptBalls, are_found_where_they_come_near_on_their_way) {
  SweptBalls balls;
  const int count = 50;
  std::vector<core::Vec3> centre, way;
  for (int i = 0; i < count; ++i) {
    centre.push_back(point(i, 0, 10));
    way.push_back(i % 3 == 0 ? core::Vec3(point(i, 3, 4) - core::Vec3(2, 2, 2))
                             : core::Vec3(core::Vec3::Zero()));
    balls.add(centre.back(), 0.2, way.back(), i / 7);
  }
  std::size_t num_found = 0;
  for (int query = 0; query < 40; ++query) {
    const Box box = swept_box(point(query, 10, 10), 0.3, point(query, 13, 2));
    const std::vector<int> found = near(balls, box);
    num_found += found.size();
    for (int i = 0; i < count; ++i) {
      bool meets = false;
      for (int share = 0; share <= 100; ++share) {
        const core::Vec3 at = centre[i] + 0.01 * share * way[i];
        Box ball;
        for (std::size_t k = 0; k < 3; ++k) {
          ball.min[k] = at[static_cast<int>(k)] - 0.2;
          ball.max[k] = at[static_cast<int>(k)] + 0.2;
        }
        meets = meets || ball.overlaps(box);
      }
      EXPECT_TRUE(!meets || std::binary_search(found.begin(), found.end(), i)) << query << ", ball " << i;
    }
  }
  EXPECT_GT(num_found, 0u);
  EXPECT_LT(num_found, 40u * count / 2) << "most balls are far from a small box";
}

TEST(SweptBalls, of_the_family_that_is_left_out_are_not_found) {
  SweptBalls balls;
  for (int i = 0; i < 60; ++i) balls.add({0, 0, 0}, 1, core::Vec3::Zero(), i / 20 % 2);  // 0, 1, 0
  const Box box = swept_box({0, 0, 0}, 1, core::Vec3::Zero());
  std::vector<int> middle(20);
  std::iota(middle.begin(), middle.end(), 20);
  EXPECT_EQ(near(balls, box).size(), 60u);
  EXPECT_EQ(near(balls, box, 0), middle);
  EXPECT_EQ(near(balls, box, 1).size(), 40u);
}

TEST(SweptBalls, are_forgotten_when_cleared) {
  SweptBalls balls;
  balls.add({0, 0, 0}, 1, core::Vec3::Zero(), 0);
  balls.clear();
  balls.add({5, 0, 0}, 1, core::Vec3::Zero(), 0);
  EXPECT_TRUE(near(balls, swept_box({0, 0, 0}, 1, core::Vec3::Zero())).empty());
  EXPECT_EQ(near(balls, swept_box({5, 0, 0}, 1, core::Vec3::Zero())), std::vector<int>{0});
}

TEST(SweptBalls, are_everywhere_if_endless_and_nowhere_if_not_finite) {
  SweptBalls balls;
  balls.add({0, 0, 0}, std::numeric_limits<double>::infinity(), core::Vec3::Zero(), 0);
  balls.add(core::Vec3::Constant(std::numeric_limits<double>::quiet_NaN()), 1, core::Vec3::Zero(), 0);
  EXPECT_EQ(near(balls, swept_box({5, 100, 0}, 1, core::Vec3::Zero())), std::vector<int>{0});
}

}  // namespace
}  // namespace pbmpi::geometry
