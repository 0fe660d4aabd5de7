#include "model/space_map.h"

#include <gtest/gtest.h>

#include "support/models.h"

namespace pbmpi::model {
namespace {

/// Three balls; the first two joined.
Model balls() {
  Model model;
  model.spaces = {"a", "b", "c"};
  support::add_ground(model);
  for (int i = 0; i < 3; ++i) {
    const std::string name = "ball" + std::to_string(i);
    support::add_solid(model, support::add_actor(model, name), name, Shape::sphere, {0.1, 0, 0}, 1,
                       {1.0 * i, 0, 1});
    model.geoms.back().space = i;
  }
  support::add_joint(model, JointKind::hinge, 0, 1, {0.5, 0, 1});
  return model;
}

TEST(SpaceMap, keeps_joined_bodies_in_one_space) {
  const SpaceMap map = make_space_map(balls());
  EXPECT_EQ(map.unit_of_body, (std::vector<int>{0, 0, 1}));
  EXPECT_EQ(map.bodies_of_unit, (std::vector<std::vector<int>>{{0, 1}, {2}}));
  EXPECT_EQ(map.space_of_unit, (std::vector<int>{0, 2})) << "of one geom in each space, the lowest";
  EXPECT_EQ(map.geoms_of_space, (std::vector<std::vector<int>>{{1, 2}, {}, {3}})) << "the ground is in none";
  EXPECT_EQ(map.units_of_space, (std::vector<std::vector<int>>{{0}, {}, {1}}));
  EXPECT_EQ(map.space_of_body(1), 0);
}

TEST(SpaceMap, puts_a_unit_into_the_space_of_most_of_its_geoms) {
  Model model = balls();
  model.geoms.push_back(model.geoms[2]);  // another geom of the second ball
  EXPECT_EQ(make_space_map(model).space_of_unit[0], 1);
}

TEST(SpaceMap, counts_the_rows_of_joints_and_motors) {
  Model model = balls();
  EXPECT_EQ(make_space_map(model).rows_of_unit, (std::vector<int>{5, 0}));
  model.joints[0].motors[0].max_force = 3;
  EXPECT_EQ(make_space_map(model).rows_of_unit, (std::vector<int>{6, 0}));
}

TEST(SpaceMap, finds_equal_units) {
  const SpaceMap map = make_space_map(support::crash());
  ASSERT_EQ(map.num_units(), 3) << "a car and two ragdolls";
  EXPECT_EQ(map.num_shapes(), 2);
  EXPECT_EQ(map.shape_of_unit[1], map.shape_of_unit[2]);
}

}  // namespace
}  // namespace pbmpi::model
