#include "scenes/parts/at_rest.h"

#include <gtest/gtest.h>

#include "../helpers.h"

namespace pbmpi::scenes {
namespace {

TEST(AtRest, has_no_events_and_no_speed) {
  const auto model = build("title = \"t\"\nbase = \"CrashWa\"\nat_rest = true\n");
  EXPECT_TRUE(model->events.empty());
  for (const model::Body& one : model->bodies) {
    EXPECT_TRUE(one.velocity.isZero() && one.angular_velocity.isZero()) << one.name;
  }
  for (const model::Joint& one : model->joints) {
    EXPECT_EQ(one.motors[0].velocity, 0) << one.name;
    EXPECT_EQ(one.motors[1].velocity, 0) << one.name;
  }
}

// 0.1 mm: the depth in which every actor starts.
TEST(AtRest, lays_rounds_in_flight_on_the_ground) {
  const auto flying = parse(find_scene("Battle").text)->build(0, 1);
  const auto lying = build("title = \"t\"\nbase = \"Battle\"\nat_rest = true\n");
  EXPECT_GT(body(*flying, "salvo_low.1").pose.position.z(), 1);
  EXPECT_NEAR(body(*lying, "salvo_low.1").pose.position.z(), 0.1 - 1e-4, 1e-12);   // its radius
  EXPECT_NEAR(body(*lying, "salvo_high.1").pose.position.z(), 0.1 - 1e-4, 1e-12);  // half its height
}

TEST(AtRest, changes_nothing_where_nothing_happens) {
  const std::string scene = scene_with("box", "size = [1, 1, 1]\nmass = 1\nposition = [0, 0, 5]\n");
  model::Model resting = *build(scene);
  bring_to_rest(resting);
  EXPECT_EQ(fingerprint(resting), fingerprint(*build(scene)));
}

}  // namespace
}  // namespace pbmpi::scenes
