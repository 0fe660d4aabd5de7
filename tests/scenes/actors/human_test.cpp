#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <map>

#include "../helpers.h"
#include "model/joint_gap.h"

namespace pbmpi::scenes {
namespace {

using model::JointKind;

/// Lowest and highest point of all geoms [m].
std::pair<double, double> extent_z(const model::Model& model) {
  double low = 1e9, high = -1e9;
  for (const model::Geom& geom : model.geoms) {
    if (geom.body == model::no_body) continue;
    const Pose& pose = model.bodies[geom.body].pose;
    const double half = geom.shape == model::Shape::box ? geom.size[2] / 2 : geom.size[1] / 2 + geom.size[0];
    const double middle = pose.point_to_outer(geom.local.position).z();
    low = std::min(low, middle - half);
    high = std::max(high, middle + half);
  }
  return {low, high};
}

TEST(Human, has_16_segments_and_15_joints_of_four_kinds) {
  const auto model = build(scene_with("human"));
  EXPECT_EQ(model->num_bodies(), 16);
  ASSERT_EQ(model->joints.size(), 15u);
  std::map<JointKind, int> kinds;
  for (const model::Joint& j : model->joints) ++kinds[j.kind];
  EXPECT_EQ(kinds[JointKind::ball], 2);       // shoulders
  EXPECT_EQ(kinds[JointKind::hinge], 4);      // elbows, knees
  EXPECT_EQ(kinds[JointKind::universal], 6);  // lumbar, neck, wrists, hips
  EXPECT_EQ(kinds[JointKind::fixed], 3);      // thoracic, ankles
}

TEST(Human, weighs_and_measures_what_the_file_says) {
  for (const auto& [mass, height] : {std::pair{75.0, 1.75}, std::pair{50.0, 1.60}, std::pair{100.0, 1.95}}) {
    const auto model = build(scene_with(
        "human", "mass = " + std::to_string(mass) + "\nheight = " + std::to_string(height) + "\n"));
    double sum = 0;
    for (const model::Body& segment : model->bodies) sum += segment.mass_kg;
    EXPECT_NEAR(sum, mass, 1e-12 * mass);  // de Leva's fractions sum to 1 exactly; rounding of 16 additions
    const auto [low, high] = extent_z(*model);
    EXPECT_NEAR(high - low, height, 1e-12);  // rounding
  }
}

TEST(Human, stands_with_flat_feet_that_just_touch_the_ground) {
  const auto [low, high] = extent_z(*build(scene_with("human")));
  EXPECT_LT(low, 0);
  EXPECT_GT(low, -1e-3);  // less than a millimetre deep
}

TEST(Human, joins_segments_without_a_gap_wherever_he_stands) {
  for (const char* keys : {"", "heading = 37\nposition = [3, -2, 0.1]\n", "stance = 12\nheading = -100\n"}) {
    const auto model = build(scene_with("human", keys));
    EXPECT_LT(model::max_joint_gap(*model, model::initial_state(*model)), 1e-14) << keys;  // rounding at 4 m
  }
}

TEST(Human, has_positive_definite_inertias_that_a_real_body_can_have) {
  const auto model = build(scene_with("human"));
  for (const model::Body& segment : model->bodies) {
    const Eigen::SelfAdjointEigenSolver<model::Mat3> eigen(segment.inertia);
    const model::Vec3 moments = eigen.eigenvalues();
    EXPECT_GT(moments[0], 0) << segment.name;
    EXPECT_GE(moments[0] + moments[1], moments[2]) << segment.name;  // true of every mass distribution
  }
}

TEST(Human, has_joint_limits_round_the_standing_pose_and_muscles_where_it_has_limits) {
  const auto model = build(scene_with("human"));
  int num_limits = 0;
  for (const model::Joint& j : model->joints) {
    for (int axis = 0; axis < 2; ++axis) {
      EXPECT_EQ(j.limits[axis].active(), j.motors[axis].active()) << j.name;
      if (!j.limits[axis].active()) continue;
      ++num_limits;
      EXPECT_LE(j.limits[axis].low, 0) << j.name;
      EXPECT_GE(j.limits[axis].high, 0) << j.name;
      EXPECT_LT(j.limits[axis].low, j.limits[axis].high) << j.name;
    }
  }
  EXPECT_EQ(num_limits, 4 + 2 * 6);  // hinges have one axis, universal joints two
}

TEST(Human, is_the_mirror_image_of_himself) {
  const auto model = build(scene_with("human"));
  for (const char* segment : {"upper_arm", "forearm", "hand", "thigh", "shank", "foot"}) {
    const model::Body& left = body(*model, std::string("a.left_") + segment);
    const model::Body& right = body(*model, std::string("a.right_") + segment);
    EXPECT_GT(left.pose.position.y(), 0) << segment;
    EXPECT_EQ(left.pose.position.y(), -right.pose.position.y()) << segment;
    EXPECT_EQ(left.pose.position.z(), right.pose.position.z()) << segment;
    EXPECT_EQ(left.mass_kg, right.mass_kg) << segment;
  }
}

TEST(Human, a_stride_keeps_his_feet_on_the_ground_and_puts_one_forward) {
  const auto model = build(scene_with("human", "stance = 12\n"));
  const Vec3 left = body(*model, "a.left_foot").pose.position;
  const Vec3 right = body(*model, "a.right_foot").pose.position;
  EXPECT_NEAR(left.z(), right.z(), 1e-12);  // rounding
  EXPECT_GT(left.x() - right.x(), 0.3);     // 2 x 0.86 m x sin 12 degrees = 0.36 m
  EXPECT_GT(extent_z(*model).first, -1e-3);
}

TEST(Human, his_tone_scales_the_torques) {
  const auto strong = build(scene_with("human"));
  const auto weak = build(scene_with("human", "tone = 0.5\n"));
  EXPECT_DOUBLE_EQ(joint(*weak, "a.left_knee").motors[0].max_force,
                   0.5 * joint(*strong, "a.left_knee").motors[0].max_force);
}

TEST(Human, refuses_a_body_that_no_human_has) {
  const std::string message = error_of(scene_with("human", "mass = 500\n"));
  EXPECT_EQ(message.find("test.toml:8:8: actor 'a': mass and height do not make a human"), 0u) << message;
}

}  // namespace
}  // namespace pbmpi::scenes
