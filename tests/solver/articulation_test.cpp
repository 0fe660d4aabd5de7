#include "solver/joints/articulation_tree.h"

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

TEST(Articulation, hangs_where_a_joint_holds_it_to_the_world) {
  EXPECT_TRUE(find_articulations(support::chain(3))[0].shape.hangs());
  for (const Articulation& part : find_articulations(support::crash())) EXPECT_FALSE(part.shape.hangs());
}

// A stop at one end alone leaves the other open.
TEST(Articulation, is_strained_where_a_slider_has_no_end) {
  const auto is_strained = [](double low, double high) {
    model::Model model;
    const int actor = support::add_actor(model, "cart");
    for (const double x : {0.0, 0.2})
      support::add_solid(model, actor, "box", model::Shape::box, {0.3, 0.3, 0.3}, 1, {x, 0, 0});
    support::add_joint(model, model::JointKind::slider, 1, 0, {0.1, 0, 0}, model::Vec3::UnitX());
    model.joints[0].limits[0] = {low, high};
    return find_articulations(model)[0].shape.is_strained;
  };
  const double none = model::infinity;
  EXPECT_TRUE(is_strained(-none, none));
  EXPECT_TRUE(is_strained(-0.1, none));
  EXPECT_TRUE(is_strained(-none, 0.1));
  EXPECT_FALSE(is_strained(-0.1, 0.1));
}

TEST(ArticulationTree, holds_each_body_once_parents_first_and_names_the_loops) {
  ArticulationShape shape;
  shape.num_bodies = 4;
  using model::JointKind;
  shape.joints = {{JointKind::ball, 1, 0},
                  {JointKind::ball, 2, 1},
                  {JointKind::ball, 0, 2},
                  {JointKind::ball, 3, 4},
                  {JointKind::ball, 3, 0}};
  const ArticulationTree tree(shape);
  ASSERT_EQ(tree.nodes.size(), 4u);
  EXPECT_EQ(tree.nodes[0].body, 3) << "hangs on the world";
  EXPECT_EQ(tree.nodes[0].parent, shape.num_bodies);
  EXPECT_TRUE(tree.nodes[0].is_first);
  std::vector<char> seen(5, 0);
  seen[4] = 1;
  for (const TreeNode& node : tree.nodes) {
    EXPECT_EQ(seen[static_cast<std::size_t>(node.parent)], 1) << node.body;
    EXPECT_EQ(seen[static_cast<std::size_t>(node.body)], 0) << node.body;
    seen[static_cast<std::size_t>(node.body)] = 1;
  }
  ASSERT_EQ(tree.loops.size(), 1u);
  EXPECT_EQ(tree.loops[0], 1) << "0 reaches 1 and 2 before they reach each other";
}

TEST(ArticulationTree, without_the_world_begins_at_the_first_body) {
  const ArticulationTree tree({.num_bodies = 2, .joints = {{model::JointKind::hinge, 1, 0}}});
  ASSERT_EQ(tree.nodes.size(), 2u);
  EXPECT_EQ(tree.nodes[0].body, 0);
  EXPECT_EQ(tree.nodes[0].joint, -1);
  EXPECT_EQ(tree.nodes[1].parent, 0);
  EXPECT_TRUE(tree.nodes[1].is_first);
  EXPECT_TRUE(tree.loops.empty());
}

}  // namespace
}  // namespace pbmpi::solver
