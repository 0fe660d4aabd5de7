#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "../helpers.h"

namespace pbmpi::scenes {
namespace {

const std::string small_wall = "length = 4\nheight = 1.2\nblock = [0.8, 0.5, 0.4]\n";

double volume_of(const model::Geom& geom) { return geom.size[0] * geom.size[1] * geom.size[2]; }

TEST(Wall, lays_courses_in_running_bond_with_half_blocks_at_the_ends_of_every_second) {
  const auto model = build(scene_with("wall", small_wall));
  EXPECT_EQ(model->num_bodies(), 5 + 6 + 5);
  // The joint between the first two blocks of a course stands over the middle of a block below.
  const double below = body(*model, "a.1_1").pose.position.x();
  const double half = body(*model, "a.2_1").pose.position.x();
  EXPECT_NEAR(half - (-2), 0.2, 1e-9);
  EXPECT_NEAR(half + 0.2, below, 1e-9);
}

TEST(Wall, weighs_its_volume_times_its_density) {
  const auto model = build(scene_with("wall", small_wall));
  double mass = 0, volume = 0;
  for (const model::Geom& geom : model->geoms) {
    if (geom.body == model::no_body) continue;
    mass += model->bodies[geom.body].mass_kg;
    volume += volume_of(geom);
  }
  EXPECT_NEAR(mass, 600 * volume, 1e-6);                      // rounding
  EXPECT_NEAR(volume, 4 * 1.2 * 0.5, 0.005 * 4 * 1.2 * 0.5);  // joints of 2 mm in 0.8 m
}

TEST(Wall, leaves_its_opening_free_and_bridges_it_with_a_lintel) {
  const auto model = build(scene_with("wall",
                                      "length = 6\nheight = 2.4\nblock = [0.8, 0.5, 0.4]\n"
                                      "opening = { width = 1.2, height = 1.6 }\n"));
  double longest = 0;
  for (const model::Geom& geom : model->geoms) {
    if (geom.body == model::no_body) continue;
    const Vec3 centre = model->bodies[geom.body].pose.position;
    const double gap = std::abs(centre.x()) - geom.size[0] / 2;  // from the block to the opening's middle
    if (centre.z() < 1.6) {
      EXPECT_GE(gap, 0.6) << model->bodies[geom.body].name;
    }
    longest = std::max(longest, geom.size[0]);
  }
  EXPECT_NEAR(longest, 1.2 + 0.8, 0.01);  // half a block's bearing at each end, minus a joint
}

struct Mistake {
  const char* keys;
  const char* place;
  const char* message;
};
class WallMistakes : public testing::TestWithParam<Mistake> {};

TEST_P(WallMistakes, are_told_at_their_place) {
  const std::string message = error_of(scene_with("wall", GetParam().keys));
  EXPECT_EQ(message.find(GetParam().place), 0u) << message;
  EXPECT_NE(message.find(GetParam().message), std::string::npos) << message;
}

INSTANTIATE_TEST_SUITE_P(
    All, WallMistakes,
    testing::Values(
        Mistake{"length = 0.5\nheight = 0.4\nblock = [0.8, 0.5, 0.4]\n", "test.toml:8:10",
                "the wall has no block"},
        Mistake{"length = 4\nheight = 0.1\nblock = [0.8, 0.5, 0.4]\n", "test.toml:9:10",
                "no course of blocks"},
        Mistake{"length = 4\nheight = 0\nblock = [0.8, 0.5, 0.4]\n", "test.toml:9:10", "must be above 0"},
        Mistake{"length = 4\nheight = 1\nblock = [0.8, 0.5, 0.4]\n", "test.toml:9:10",
                "whole number of courses"},
        Mistake{"length = 4\nheight = 1.2\nblock = [0.8, 0.5, 0.4]\nopening = { width = 4, height = 0.4 }\n",
                "test.toml:11:21", "no pier"},
        Mistake{"length = 4\nheight = 1.2\nblock = [0.8, 0.5, 0.4]\nopening = { width = 1, height = 1.2 }\n",
                "test.toml:11:33", "no course is left"}));

}  // namespace
}  // namespace pbmpi::scenes
