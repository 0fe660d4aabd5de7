#include "solver/layout/articulation.h"

#include <gtest/gtest.h>

#include "support/models.h"

namespace pbmpi::solver {
namespace {

TEST(Articulation, a_crash_is_a_car_and_two_equal_ragdolls) {
  const model::Model model = support::crash();
  const auto parts = find_articulations(model);
  ASSERT_EQ(parts.size(), 3u);
  std::vector<int> seen(model.bodies.size(), 0);
  std::size_t num_joints = 0;
  for (const Articulation& part : parts) {
    EXPECT_EQ(part.bodies.size(), static_cast<std::size_t>(part.shape.num_bodies));
    for (int body : part.bodies) ++seen[static_cast<std::size_t>(body)];
    num_joints += part.joints.size();
  }
  EXPECT_EQ(seen, std::vector<int>(model.bodies.size(), 1)) << "each body is in one articulation";
  EXPECT_EQ(num_joints, model.joints.size());
  EXPECT_EQ(parts[1].shape, parts[2].shape) << "the ragdolls can share lanes wherever they stand";
  EXPECT_NE(parts[0].shape, parts[1].shape);
}

TEST(Articulation, single_bodies_have_no_joint_and_one_shape) {
  const auto parts = find_articulations(support::pile(5));
  ASSERT_EQ(parts.size(), 5u);
  for (const Articulation& part : parts) {
    EXPECT_EQ(part.shape, parts[0].shape);
    EXPECT_TRUE(part.joints.empty());
  }
}

TEST(Articulation, a_joint_to_the_world_points_past_the_last_body) {
  const auto parts = find_articulations(support::pendulum(1, 0.3));
  ASSERT_EQ(parts.size(), 1u);
  EXPECT_EQ(parts[0].shape.joints[0].body_b, parts[0].shape.num_bodies);
}

}  // namespace
}  // namespace pbmpi::solver
