// One body of several geoms.
#include <gtest/gtest.h>

#include "../helpers.h"
#include "scenes/parts/mass_properties.h"

namespace pbmpi::scenes {
namespace {

/// A hammer: its head is a box across the end of a handle along x.
const std::string hammer =
    scene_with("compound",
               "geoms = [\n"
               "{ shape = \"cylinder\", radius = 0.02, length = 0.3, position = [0.15, 0, 0],"
               " rotation = { axis = [0, 1, 0], angle = 90 } },\n"
               "{ shape = \"box\", size = [0.04, 0.1, 0.04], position = [0.3, 0, 0] }]\n");

TEST(Compound, is_one_body_whose_geoms_keep_their_places_in_the_actors_frame) {
  const auto model = build(hammer + "mass = 1\nposition = [2, 0, 1]\nheading = 90\n");
  ASSERT_EQ(model->num_bodies(), 1);
  ASSERT_EQ(model->geoms.size(), 3u);  // includes the ground
  const model::Geom& head = model->geoms[2];
  EXPECT_EQ(head.body, 0);
  const Vec3 middle = body(*model, "a").pose.point_to_outer(head.local.position);
  EXPECT_LT((middle - Vec3(2, 0.3, 1)).norm(), 1e-15);  // rounding
  EXPECT_LT((model->geoms[1].local.direction_to_outer(Vec3::UnitZ()) - Vec3::UnitX()).norm(), 1e-15);
}

TEST(Compound, has_its_centre_of_mass_where_the_parts_have_it) {
  const auto model = build(hammer + "density = 1000\nposition = [2, 0, 1]\n");
  const double handle = 1000 * volume(model::Shape::cylinder, {0.02, 0.3});
  const double head = 1000 * 0.04 * 0.1 * 0.04;
  const model::Body& found = body(*model, "a");
  EXPECT_NEAR(found.mass_kg, handle + head, 1e-15);
  const double x = (handle * 0.15 + head * 0.3) / (handle + head);
  EXPECT_LT((found.pose.position - Vec3(2 + x, 0, 1)).norm(), 1e-15);
  EXPECT_GT(found.inertia(2, 2), handle * 0.3 * 0.3 / 12);
}

TEST(Compound, can_be_a_static_obstacle) {
  const auto model = build(hammer + "static = true\nposition = [2, 0, 1]\n[[actor]]\nname = \"b\"\n" +
                           "type = \"sphere\"\nradius = 1\nmass = 1\nposition = [0, 0, 1]\n");
  EXPECT_EQ(model->geoms[2].body, model::no_body);
  EXPECT_EQ(model->geoms[2].local.position, Vec3(2.3, 0, 1));
}

TEST(Compound, that_cannot_be_is_refused_at_its_place) {
  const std::string none = error_of(scene_with("compound", "mass = 1\n"));
  EXPECT_NE(none.find("test.toml:5:1: actor 'a': 'geoms' is missing or empty"), std::string::npos) << none;
  const std::string flat = error_of(scene_with("compound", "mass = 1\ngeoms = [{ shape = \"plane\" }]\n"));
  EXPECT_NE(flat.find("test.toml:9:20: geom of a compound: unknown shape 'plane'"), std::string::npos)
      << flat;
  const std::string long_ball = error_of(
      scene_with("compound", "mass = 1\ngeoms = [{ shape = \"sphere\", radius = 1, length = 2 }]\n"));
  EXPECT_NE(long_ball.find("test.toml:9:42: geom of a compound: unknown key 'length'"), std::string::npos)
      << long_ball;
}

}  // namespace
}  // namespace pbmpi::scenes
