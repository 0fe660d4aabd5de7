#include <gtest/gtest.h>

#include "../helpers.h"

namespace pbmpi::scenes {
namespace {

const std::string gun =
    "heading = 90\nelevation = 5\n[[actor]]\nname = \"ball\"\ntype = \"projectile\"\nshape = \"sphere\"\n"
    "radius = 0.1\ndensity = 4000\nposition = [5, 0, 0]\ncopies = 3\nspacing = [0, 1, 0]\n"
    "fired_by = \"a\"\nmuzzle_speed = 40\ninterval = 0.25\n";

TEST(Projectile, leaves_the_muzzle_along_the_barrel_one_copy_after_the_other) {
  const auto model = build(scene_with("tank", gun + "first_shot = 0.1\n"));
  ASSERT_EQ(model->events.size(), 3u);
  const Pose barrel = body(*model, "a.barrel").pose;
  const Vec3 ahead = barrel.direction_to_outer(Vec3::UnitX());
  EXPECT_GT(ahead.y(), 0.99);  // the tank points along y, its gun 5 degrees up
  EXPECT_NEAR(ahead.z(), std::sin(5 * M_PI / 180), 1e-9);
  for (int shot = 0; shot < 3; ++shot) {
    const model::Event& event = model->events[shot];
    EXPECT_EQ(event.step, 10 + 25 * shot);
    EXPECT_EQ(model->bodies[event.body].name, "ball." + std::to_string(shot + 1));
    EXPECT_LT((event.velocity - 40 * ahead).norm(), 1e-9);
    ASSERT_TRUE(event.pose.has_value());
    const Vec3 from_barrel = event.pose->position - barrel.position;
    EXPECT_LT(from_barrel.cross(ahead).norm(), 1e-9);
    EXPECT_GT(from_barrel.norm(), 2.5 + 0.1);  // farther than half a barrel by more than its radius
  }
}

TEST(Projectile, lies_on_the_ground_until_then) {
  const auto model = build(scene_with("tank", gun + "first_shot = 0.1\n"));
  EXPECT_NEAR(body(*model, "ball.2").pose.position.z(), 0.1, 1e-3);  // the depth of a resting contact
  EXPECT_EQ(body(*model, "ball.2").velocity, Vec3(0, 0, 0));
}

TEST(Projectile, cannot_be_fired_before_step_0) {
  const std::string message = error_of(scene_with("tank", gun + "first_shot = -0.1\n"));
  EXPECT_EQ(message.find("test.toml:22:14: actor 'ball': 'first_shot' is -0.1"), 0u) << message;
}

TEST(Projectile, needs_its_tank_above_it_in_the_file) {
  const std::string message = error_of(scene_with("projectile",
                                                  "shape = \"sphere\"\nradius = 0.1\ndensity = 1\nfired_by = "
                                                  "\"tank\"\nmuzzle_speed = 1\nfirst_shot = 0\n"));
  EXPECT_EQ(message.find("test.toml:11:12: no tank 'tank'"), 0u) << message;
}

TEST(Projectile, has_one_of_three_shapes) {
  const std::string message = error_of(scene_with("projectile", "shape = \"spere\"\ndensity = 1\n"));
  EXPECT_NE(message.find("unknown shape 'spere'; did you mean 'sphere'"), std::string::npos) << message;
}

TEST(Tank, weighs_what_its_parts_weigh_and_holds_its_gun) {
  const auto model = build(scene_with("tank", "turret = 30\n"));
  EXPECT_EQ(model->num_bodies(), 3);
  EXPECT_EQ(body(*model, "a.hull").mass_kg, 38000);
  const Vec3 ahead = body(*model, "a.barrel").pose.direction_to_outer(Vec3::UnitX());
  EXPECT_NEAR(std::atan2(ahead.y(), ahead.x()), 30 * M_PI / 180, 1e-9);
  EXPECT_GT(joint(*model, "a.traverse").motors[0].max_force, 0);
}

TEST(Centipede, has_a_segment_and_two_legs_each_and_its_groups_of_legs_alternate) {
  const auto model = build(scene_with("centipede", "segments = 3\n"));
  EXPECT_EQ(model->num_bodies(), 3 * 3);
  EXPECT_EQ(model->joints.size(), 2u + 6u);
  const auto first_swing = [&](const std::string& name) {
    for (const model::Event& event : model->events) {
      if (model->joints[event.joint].name == name && event.axis == 0) return event.motor.velocity;
    }
    return 0.0;
  };
  EXPECT_GT(first_swing("a.left_leg1_hip"), 0);
  EXPECT_LT(first_swing("a.right_leg1_hip"), 0);
  EXPECT_LT(first_swing("a.left_leg2_hip"), 0);
}

}  // namespace
}  // namespace pbmpi::scenes
