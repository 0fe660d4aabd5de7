#include "scenes/format/event_reader.h"

#include <gtest/gtest.h>

#include "../helpers.h"

namespace pbmpi::scenes {
namespace {

// The event begins at line 13.
const std::string hung_box = R"(title = "t"
[[actor]]
name = "box"
type = "box"
size = [1, 1, 1]
mass = 1
[[joint]]
name = "hook"
kind = "ball"
bodies = ["box", "world"]
anchor = [0, 0, 1]

[[event]]
)";

TEST(EventReader, launches_a_body_from_where_it_is) {
  const auto model = build(hung_box + "at = 0.5\nbody = \"box\"\nvelocity = [1, 2, 3]\n");
  ASSERT_EQ(model->events.size(), 1u);
  const model::Event& event = model->events[0];
  EXPECT_EQ(event.kind, model::EventKind::launch);
  EXPECT_EQ(event.step, 50);  // of 0.01 s
  EXPECT_EQ(event.body, 0);
  EXPECT_EQ(event.velocity, Vec3(1, 2, 3));
  EXPECT_FALSE(event.pose);
}

TEST(EventReader, puts_a_body_elsewhere) {
  const auto model = build(hung_box +
                           "at = 0\nbody = \"box\"\nposition = [0, 0, 9]\nangular_velocity = [0, 0, 4]\n"
                           "rotation = { axis = [0, 0, 1], angle = 180 }\n");
  const model::Event& event = model->events[0];
  ASSERT_TRUE(event.pose);
  EXPECT_EQ(event.pose->position, Vec3(0, 0, 9));
  EXPECT_NEAR(event.pose->orientation.z, 1, 1e-15);  // rounding of a sine
  EXPECT_EQ(event.angular_velocity, Vec3(0, 0, 4));
  EXPECT_EQ(event.velocity, Vec3(0, 0, 0));
}

TEST(EventReader, releases_a_joint) {
  const auto model = build(hung_box + "at = 1.2\nrelease = \"hook\"\n");
  EXPECT_EQ(model->events[0].kind, model::EventKind::release);
  EXPECT_EQ(model->events[0].joint, 0);
  EXPECT_EQ(model->events[0].step, 120);
}

TEST(EventReader, tells_of_names_that_are_not_there) {
  const std::string body = error_of(hung_box + "at = 0\nbody = \"bax\"\n");
  EXPECT_EQ(body.find("test.toml:15:8: event: unknown body 'bax'; did you mean 'box'"), 0u) << body;
  const std::string joint = error_of(hung_box + "at = 1\nrelease = \"hock\"\n");
  EXPECT_EQ(joint.find("test.toml:15:11: event: unknown joint 'hock'; did you mean 'hook'"), 0u) << joint;
}

TEST(EventReader, refuses_a_launch_that_is_a_release_and_an_event_that_is_neither) {
  const std::string both = error_of(hung_box + "at = 1\nbody = \"box\"\nrelease = \"hook\"\n");
  EXPECT_NE(both.find("event: give either 'body', which is launched, or 'release'"), std::string::npos)
      << both;
  EXPECT_NE(error_of(hung_box + "at = 1\n").find("give either 'body'"), std::string::npos);
}

TEST(EventReader, refuses_a_release_at_the_start_and_a_turn_without_a_place) {
  const std::string release = error_of(hung_box + "at = 0\nrelease = \"hook\"\n");
  EXPECT_EQ(release.find("test.toml:14:6: event: a joint can be released one step after the start"), 0u)
      << release;
  const std::string turn =
      error_of(hung_box + "at = 0\nbody = \"box\"\nrotation = { axis = [1, 0, 0], angle = 3 }\n");
  EXPECT_EQ(turn.find("test.toml:16:12: event: give the 'position'"), 0u) << turn;
}

TEST(EventReader, leaves_out_with_the_effect_what_it_would_do) {
  EXPECT_TRUE(
      build(hung_box + "at = 1\nrelease = \"hook\"\n[effects]\nbreakable_joints = false\n")->events.empty());
  EXPECT_TRUE(build(hung_box + "at = 1\nbody = \"box\"\n[effects]\nevents = false\n")->events.empty());
}

}  // namespace
}  // namespace pbmpi::scenes
