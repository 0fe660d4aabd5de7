#include <gtest/gtest.h>

#include <numbers>

#include "../helpers.h"
#include "core/error.h"
#include "stepping/observables.h"

namespace pbmpi::scenes {
namespace {

using std::numbers::pi;

TEST(Car, is_a_chassis_on_four_sprung_and_steered_wheels) {
  const auto model = build(scene_with("car"));
  EXPECT_EQ(model->num_bodies(), 5);
  ASSERT_EQ(model->joints.size(), 4u);
  for (const model::Joint& j : model->joints) {
    EXPECT_EQ(j.kind, model::JointKind::hinge2);
    EXPECT_GT(j.suspension.stiffness, 0);
  }
  double mass = 0;
  for (const model::Body& part : model->bodies) mass += part.mass_kg;
  EXPECT_NEAR(mass, 1280, 1e-9);  // 1200 kg and four wheels of 20 kg
}

TEST(Car, has_wheels_that_come_off_and_can_hit_it_only_where_the_file_says_so) {
  const auto whole = build(scene_with("car"));
  const auto weak = build(scene_with("car", "wheel_break_force = 5000\n"));
  for (const model::Joint& j : whole->joints) EXPECT_FALSE(j.breakable());
  for (const model::Joint& j : weak->joints) EXPECT_EQ(j.break_force, 5000);
  EXPECT_FALSE(whole->actors[whole->bodies[0].actor].self_collision);
  EXPECT_TRUE(weak->actors[weak->bodies[0].actor].self_collision);
  EXPECT_NE(error_of(scene_with("car", "wheel_break_force = -1\n")).find("wheel_break_force"),
            std::string::npos);
}

TEST(Car, springs_carry_the_chassis_at_its_initial_height) {
  const auto model = build(scene_with("car", "heading = 25\nposition = [3, 4, 0]\n"));
  double carried_n = 0;
  for (const model::Joint& j : model->joints) {
    const Vec3 hub = body(*model, model->bodies[j.body_b].name).pose.point_to_outer(j.anchor_b);
    const Vec3 anchor = model->bodies[j.body_a].pose.point_to_outer(j.anchor_a);
    EXPECT_LT((hub - anchor).head<2>().norm(), 1e-14);  // the spring acts straight up; rounding at 4 m
    carried_n += j.suspension.stiffness * (hub - anchor).z();
  }
  EXPECT_NEAR(carried_n, 1200 * 9.81, 1e-8);  // the chassis' weight; rounding of 12 kN
}

TEST(Car, suspension_has_the_frequency_and_damping_that_the_file_says) {
  const auto model = build(scene_with("car", "suspension_frequency = 1.5\ndamping_ratio = 0.3\n"));
  const model::Spring& spring = model->joints[0].suspension;
  const double omega = std::sqrt(4 * spring.stiffness / 1200);
  EXPECT_NEAR(omega / (2 * pi), 1.5, 1e-12);
  EXPECT_NEAR(spring.damping / (2 * std::sqrt(spring.stiffness * 1200 / 4)), 0.3, 1e-12);
}

TEST(Car, wheels_roll_without_slip_along_the_heading) {
  const auto model = build(scene_with("car", "speed = 15\nheading = 90\n"));
  for (const model::Body& part : model->bodies) {
    EXPECT_LT((part.velocity - Vec3(0, 15, 0)).norm(), 1e-14) << part.name;  // rounding
  }
  const model::Body& wheel = body(*model, "a.front_left");
  const Vec3 lowest = wheel.velocity + wheel.angular_velocity.cross(Vec3(0, 0, -0.3));
  EXPECT_LT(lowest.norm(), 1e-13);  // rounding
}

TEST(Car, only_a_given_drive_torque_drives_the_rear_wheels) {
  const auto coasting = build(scene_with("car", "speed = 15\n"));
  for (const model::Joint& j : coasting->joints) EXPECT_FALSE(j.motors[1].active());
  const auto driven = build(scene_with("car", "speed = 15\ndrive_torque = 400\n"));
  EXPECT_DOUBLE_EQ(joint(*driven, "a.rear_left_suspension").motors[1].velocity, 15 / 0.3);
  EXPECT_FALSE(joint(*driven, "a.front_left_suspension").motors[1].active());
}

/// The steering angle [degrees] that holds at the end of `step` for the front left wheel.
double angle_at(const model::Model& model, std::int64_t step) {
  double angle = 0;
  for (const model::Event& event : model.events) {
    if (event.step <= step && model.joints[event.joint].name == "a.front_left_suspension")
      angle = event.angle;
  }
  return angle * 180 / pi;
}

TEST(Car, steers_along_straight_lines_between_the_points_of_its_programme) {
  const auto model = build(scene_with("car", "steering = [[0.1, 0], [0.3, 10], [0.5, 10], [0.6, -5]]\n"));
  constexpr double rounding = 1e-12;
  EXPECT_NEAR(angle_at(*model, 5), 0, rounding);
  EXPECT_NEAR(angle_at(*model, 20), 5, rounding);
  EXPECT_NEAR(angle_at(*model, 30), 10, rounding);
  EXPECT_NEAR(angle_at(*model, 45), 10, rounding);
  EXPECT_NEAR(angle_at(*model, 58), -2, rounding);
  EXPECT_NEAR(angle_at(*model, 1000), -5, rounding);
}

TEST(Car, steers_at_the_same_times_with_another_time_step) {
  const SceneSource source{"t", "t.toml", scene_with("car", "steering = [[0, 0], [0.2, 8]]\n")};
  const auto fine = parse_scene(source, 0.001)->build(0, 1);
  EXPECT_NEAR(angle_at(*fine, 100), 4, 1e-12);
  EXPECT_NEAR(angle_at(*fine, 200), 8, 1e-12);
}

TEST(Car, has_events_in_the_order_of_their_steps) {
  const auto model = parse_scene(find_scene("10-Cars"))->build(0, 1);
  ASSERT_FALSE(model->events.empty());
  for (std::size_t i = 1; i < model->events.size(); ++i) {
    EXPECT_LE(model->events[i - 1].step, model->events[i].step);
  }
}

TEST(Car, refuses_a_programme_that_goes_back_in_time_or_turns_too_far) {
  const std::string back = error_of(scene_with("car", "steering = [[0.2, 0], [0.1, 5]]\n"));
  EXPECT_EQ(back.find("test.toml:8:23: actor 'a': the entries of 'steering' must ascend"), 0u) << back;
  const std::string far = error_of(scene_with("car", "steering = [[0, 90]]\n"));
  EXPECT_EQ(far.find("test.toml:8:12: actor 'a': steering angles must lie within 60 degrees"), 0u) << far;
}

}  // namespace
}  // namespace pbmpi::scenes
