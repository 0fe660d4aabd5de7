#include "scenes/actors/variation.h"

#include <gtest/gtest.h>

#include <set>

#include "../helpers.h"

namespace pbmpi::scenes {
namespace {

const std::string varied_ball = R"(title = "t"
[[actor]]
name = "ball"
type = "sphere"
radius = 0.1
mass = 1
position = [1, 2, 3]
velocity = [4, 5, 6]
variation = { position = [0.1, 0, 0.3], velocity = [0, 0.5, 0] }
)";

TEST(Variation, gives_the_same_world_the_same_bits) {
  const auto scene = parse_scene(find_scene("100CrSk"));
  const auto again = parse_scene(find_scene("100CrSk"));
  for (const int world : {0, 1, 99}) {
    EXPECT_EQ(fingerprint(*scene->build(world, 7)), fingerprint(*again->build(world, 7))) << world;
  }
}

TEST(Variation, does_not_depend_on_the_order_in_which_worlds_are_built) {
  const auto scene = parse(varied_ball);
  const auto first = fingerprint(*scene->build(3, 1));
  for (int world = 10; world-- > 0;) scene->build(world, 1);
  EXPECT_EQ(fingerprint(*scene->build(3, 1)), first);
}

TEST(Variation, differs_from_world_to_world_and_from_seed_to_seed) {
  const auto scene = parse(varied_ball);
  std::set<std::uint64_t> prints;
  for (int world = 0; world < 50; ++world) {
    for (const std::uint64_t seed : {1, 2}) prints.insert(fingerprint(*scene->build(world, seed)));
  }
  EXPECT_EQ(prints.size(), 100u);
}

TEST(Variation, stays_within_its_half_widths_and_reaches_both_sides) {
  const auto scene = parse(varied_ball);
  double low = 1, high = 1;
  for (int world = 0; world < 200; ++world) {
    const auto model = scene->build(world, 1);
    const model::Body& ball = model->bodies[0];
    EXPECT_LE(std::abs(ball.pose.position.x() - 1), 0.1);
    EXPECT_EQ(ball.pose.position.y(), 2);
    EXPECT_LE(std::abs(ball.pose.position.z() - 3), 0.3);
    EXPECT_LE(std::abs(ball.velocity.y() - 5), 0.5);
    EXPECT_EQ(ball.velocity.x(), 4);
    low = std::min(low, ball.pose.position.x());
    high = std::max(high, ball.pose.position.x());
  }
  // The chance that none of 200 uniform draws falls into the outer tenth of a side is 0.95^200 = 4e-5.
  EXPECT_LT(low, 0.91);
  EXPECT_GT(high, 1.09);
}

TEST(Variation, draws_for_each_copy_of_its_own) {
  const auto model = build(varied_ball + "copies = 3\nspacing = [0, 0, 1]\n");
  ASSERT_EQ(model->num_bodies(), 3);
  EXPECT_EQ(model->bodies[2].name, "ball.3");
  EXPECT_NE(model->bodies[0].pose.position.x(), model->bodies[1].pose.position.x());
  EXPECT_EQ(model->bodies[0].pose.position.y(), model->bodies[1].pose.position.y());
}

TEST(Variation, refuses_to_vary_the_velocity_of_what_does_not_move) {
  const std::string message = error_after_ground("variation = { velocity = [1, 0, 0] }\n");
  EXPECT_EQ(message.find("test.toml:5:13: actor 'ground'"), 0u) << message;
}

TEST(WorldCount, changes_at_the_worlds_that_the_file_names) {
  const auto scene = parse_scene(find_scene(std::string(PBMPI_TEST_SCENES) + "/Unequal.toml"));
  EXPECT_EQ(scene->build(0, 1)->num_bodies(), 48);
  EXPECT_EQ(scene->build(3, 1)->num_bodies(), 48);
  EXPECT_EQ(scene->build(4, 1)->num_bodies(), 1);
  EXPECT_EQ(scene->build(15, 1)->num_bodies(), 1);
}

TEST(WorldCount, refuses_pairs_that_do_not_begin_at_world_0_or_do_not_ascend) {
  const std::string spacing = "spacing = [1, 0, 0]\n";
  EXPECT_NE(error_of(varied_ball + "copies = [[1, 2]]\n" + spacing).find("test.toml:10:10: "),
            std::string::npos);
  EXPECT_NE(error_of(varied_ball + "copies = [[0, 2], [0, 3]]\n" + spacing).find("must ascend"),
            std::string::npos);
  EXPECT_NE(error_of(varied_ball + "copies = [[0, 0]]\n" + spacing).find("number >= 1"), std::string::npos);
  EXPECT_NE(error_of(varied_ball + "copies = [[0, 2.5]]\n" + spacing).find("whole numbers"),
            std::string::npos);
}

}  // namespace
}  // namespace pbmpi::scenes
