// Colliding bodies bounce: the effect "restitution".
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "../helpers.h"
#include "stepped_scene.h"

namespace pbmpi::scenes {
namespace {

using effects::EffectId;

constexpr double ball_radius_m = 0.108;
constexpr int ball = 0, head_pin = 1, num_pins = 10;
constexpr double lane_s = 2;  // the ball meets the head pin after 2.1 s

Vec3 up(const model::State& state, int body) {
  return Pose{state.position[body], state.orientation[body]}.direction_to_outer(Vec3::UnitZ());
}

/// A pin that leans by more than 45 degrees, or has dropped below the lane.
bool has_fallen(const model::State& state, int pin) {
  return up(state, pin).z() < std::sqrt(0.5) || state.position[pin].z() < 0;
}

int num_fallen(const model::State& state) {
  int fallen = 0;
  for (int pin = head_pin; pin < head_pin + num_pins; ++pin) fallen += has_fallen(state, pin) ? 1 : 0;
  return fallen;
}

/// Position of a pin's belly: the second of its geoms.
Vec3 belly(const model::Model& model, const model::State& state, int pin) {
  const auto first = std::ranges::find(model.geoms, pin, &model::Geom::body);
  return Pose{state.position[pin], state.orientation[pin]}.point_to_outer((first + 1)->local.position);
}

/// The speed at which ball and head pin approach each other at the point where they meet, and the share of it
/// at which they separate after the step of the impact.
struct Blow {
  double approach_m_s = 0, bounce = 0;
};

Blow first_blow(SteppedScene& scene) {
  model::State before = scene.state();
  while (scene.time_s() < 3) {
    before = scene.state();
    scene.steps(1);
    if ((scene.state().velocity[ball] - before.velocity[ball]).norm() > 0.1) break;
  }
  const Vec3 normal = (belly(scene.model(), before, head_pin) - before.position[ball]).normalized();
  const Vec3 point = before.position[ball] + ball_radius_m * normal;
  const auto speed = [&](const model::State& state) {
    const auto at_point = [&](int body) -> Vec3 {
      return state.velocity[body] + state.angular_velocity[body].cross(point - before.position[body]);
    };
    return normal.dot(at_point(ball) - at_point(head_pin));
  };
  return {speed(before), -speed(scene.state()) / speed(before)};
}

TEST(Bowling, calls_for_restitution) {
  const SteppedScene scene("Bowling");
  EXPECT_EQ(scene.reason(EffectId::restitution), "41 geoms with restitution > 0");  // ball, 10 pins of 4
  EXPECT_EQ(scene.reason(EffectId::joints), "");
}

TEST(Bowling, its_pins_are_what_is_specified) {
  const auto model = parse_scene(find_scene("Bowling"))->build(0, 1);
  ASSERT_EQ(model->num_bodies(), 1 + num_pins);
  EXPECT_LE(body(*model, "ball").mass_kg, 7.26);  // 16 lb
  for (int pin = head_pin; pin < head_pin + num_pins; ++pin) {
    const model::Body& one = model->bodies[pin];
    EXPECT_GE(one.mass_kg, 1.53) << one.name;              // 3 lb 6 oz
    EXPECT_LE(one.mass_kg, 1.64) << one.name;              // 3 lb 10 oz
    EXPECT_GE(one.pose.position.z(), 0.1429) << one.name;  // 5 5/8 in
    EXPECT_LE(one.pose.position.z(), 0.1508) << one.name;  // 5 15/16 in
    double nearest = 1;
    for (int other = head_pin; other < head_pin + num_pins; ++other) {
      const Vec3 way = model->bodies[other].pose.position - one.pose.position;
      if (other != pin) nearest = std::min(nearest, way.norm());
    }
    EXPECT_NEAR(nearest, 0.3048, 2e-4) << one.name;  // 12 in; places are rounded to tenths of millimetres
  }
}

TEST(Bowling, its_pins_stand_until_the_ball_comes) {
  SteppedScene scene("Bowling");
  scene.seconds(lane_s);
  for (int pin = head_pin; pin < head_pin + num_pins; ++pin) {
    const Vec3 moved = scene.state().position[pin] - scene.model().bodies[pin].pose.position;
    EXPECT_LT(moved.norm(), 1e-3) << pin;
    EXPECT_GT(up(scene.state(), pin).z(), 0.9999) << pin;  // 0.8 degrees
  }
}

TEST(Bowling, its_ball_hooks_into_the_pocket) {
  SteppedScene scene("Bowling");
  scene.seconds(lane_s);
  const Vec3 velocity = scene.state().velocity[ball];
  const double degrees = std::atan2(velocity.y(), velocity.x()) * 180 / std::numbers::pi;
  EXPECT_NEAR(degrees, 4.5, 1.5);   // bowlers aim at 4 to 6
  EXPECT_GT(velocity.norm(), 7.1);  // 16 to 18 mph
  EXPECT_LT(velocity.norm(), 8.1);
}

/// In steps of one substep, so that the pin does not turn between the blow and the end of the step.
TEST(Bowling, its_ball_and_head_pin_part_at_the_share_of_their_approach_that_is_specified) {
  stepping::StepperSettings settings = default_settings(stepping::StepperKind::sor);
  const int parts = std::exchange(settings.substeps, 1);
  SteppedScene scene("Bowling", {}, settings, parts);
  scene.seconds(lane_s);
  const Blow blow = first_blow(scene);
  EXPECT_GT(blow.approach_m_s, 5);
  EXPECT_GE(blow.bounce, 0.65);  // USBC
  EXPECT_LE(blow.bounce, 0.78);
}

TEST(Bowling, its_ball_and_head_pin_do_not_part_without_restitution) {
  SteppedScene scene("Bowling", {{"restitution", false}});
  scene.seconds(lane_s);
  EXPECT_NEAR(first_blow(scene).bounce, 0,
              0.1);  // measured 0.06: the lane's contacts at the pin are not iterated to convergence
}

TEST(Bowling, most_pins_fall_and_some_fly) {
  SteppedScene scene("Bowling");
  scene.seconds(lane_s);
  double highest = 0;
  while (scene.time_s() < 3.6) {
    scene.seconds(0.03);
    for (int pin = head_pin; pin < head_pin + num_pins; ++pin)
      highest = std::max(highest, scene.state().position[pin].z());
  }
  EXPECT_EQ(scene.observables().nonfinite, 0);
  EXPECT_GE(num_fallen(scene.state()), 7);
  EXPECT_GT(highest, 0.2);  // 5 cm above where it stood
}

}  // namespace
}  // namespace pbmpi::scenes
