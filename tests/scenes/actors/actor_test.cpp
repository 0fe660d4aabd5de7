#include "scenes/actors/actor.h"

#include <gtest/gtest.h>

#include <numbers>

#include "../helpers.h"

namespace pbmpi::scenes {
namespace {

TEST(GenericBody, takes_its_mass_from_a_density) {
  const auto model =
      build(scene_with("box", "size = [0.5, 0.4, 0.1]\ndensity = 600\nposition = [0, 0, 1]\n"));
  EXPECT_DOUBLE_EQ(body(*model, "a").mass_kg, 12);  // 600 kg/m^3 x 0.02 m^3
}

TEST(GenericBody, is_turned_by_its_rotation_and_then_by_its_heading) {
  const auto model = build(scene_with(
      "capsule",
      "radius = 0.1\nlength = 1\nmass = 1\nrotation = { axis = [0, 2, 0], angle = 90 }\nheading = 90\n"
      "position = [0, 0, 1]\n"));
  // The z axis turns to x, and x to y. 1e-15: rounding of two quarter turns.
  const Vec3 axis = body(*model, "a").pose.direction_to_outer(Vec3::UnitZ());
  EXPECT_LT((axis - Vec3::UnitY()).norm(), 1e-15);
}

TEST(GenericBody, can_be_a_static_obstacle) {
  const auto model =
      build(scene_with("cylinder", "radius = 0.1\nlength = 2\nstatic = true\nposition = [1, 2, 3]\n") +
            "[[actor]]\nname = \"b\"\ntype = \"sphere\"\nradius = 1\nmass = 1\nkind = \"projectile\"\n"
            "position = [0, 0, 1]\n");
  ASSERT_EQ(model->num_bodies(), 1);
  const model::Geom& post = model->geoms[1];
  EXPECT_EQ(post.body, model::no_body);
  EXPECT_EQ(post.local.position, Vec3(1, 2, 3));
  EXPECT_EQ(model->actors[model->bodies[0].actor].kind, model::ActorKind::projectile);
}

TEST(GenericBody, refuses_a_mass_for_a_static_obstacle) {
  const std::string message = error_of(scene_with("sphere", "radius = 1\nstatic = true\nmass = 1\n"));
  EXPECT_EQ(message.find("test.toml:10:1: actor 'a': unknown key 'mass'"), 0u) << message;
}

TEST(GenericBody, takes_moments_of_inertia_of_its_own) {
  const auto model = build(
      scene_with("box", "size = [1, 1, 1]\nmass = 1\ninertia = [0.1, 0.2, 0.3]\nposition = [0, 0, 0.5]\n"));
  EXPECT_EQ(body(*model, "a").inertia.diagonal(), Vec3(0.1, 0.2, 0.3));
  EXPECT_EQ(body(*model, "a").inertia(0, 1), 0);
}

TEST(GenericBody, refuses_moments_of_inertia_that_no_body_has) {
  const std::string message = error_of(
      scene_with("box", "size = [1, 1, 1]\nmass = 1\nposition = [0, 0, 0.5]\ninertia = [0.1, 0.2, 0.31]\n"));
  EXPECT_EQ(message.find("test.toml:11:11: actor 'a': no body has a moment of inertia above the sum"), 0u)
      << message;
}

TEST(Ramp, rises_along_its_heading_from_the_ground_to_its_height) {
  const auto model =
      build(scene_with("ramp", "length = 4\nwidth = 2\nheight = 0.5\nposition = [10, 0, 0]\nheading = 90\n") +
            "[[actor]]\nname = \"b\"\ntype = \"sphere\"\nradius = 1\nmass = 1\n"
            "position = [0, 0, 1]\n");
  const model::Geom& board = model->geoms[1];
  EXPECT_EQ(board.body, model::no_body);
  const double half = board.size[0] / 2;
  const Vec3 foot = board.local.point_to_outer({-half, 0, board.size[2] / 2});
  const Vec3 top = board.local.point_to_outer({half, 0, board.size[2] / 2});
  // 1e-14 m: rounding of coordinates of 10 m.
  EXPECT_LT((foot - Vec3(10, 0, 0)).norm(), 1e-14);
  EXPECT_LT((top - Vec3(10, 4, 0.5)).norm(), 1e-14);
}

}  // namespace
}  // namespace pbmpi::scenes
