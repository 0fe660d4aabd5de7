#include "geometry/seams.h"

#include <cmath>

#include <gtest/gtest.h>

#include "core/random.h"
#include "geometry/face_contact.h"
#include "support/models.h"

namespace pbmpi::geometry {
namespace {

using core::Vec3;
using model::Shape;

/// Static boxes and one moving geom, which touches the last box.
struct Scene {
  model::Model model;
  int actor = 0, body = 0;

  Scene() {
    actor = support::add_actor(model, "tiles");
    support::add_actor(model, "mover");
  }
  int tile(const std::array<double, 3>& size, const Vec3& position, const model::Quat& turn = {}) {
    model::Geom geom;
    geom.actor = actor;
    geom.size = size;
    geom.local = {position, turn};
    model.geoms.push_back(geom);
    return static_cast<int>(model.geoms.size()) - 1;
  }
  int mover(Shape shape, const std::array<double, 3>& size, const Vec3& position,
            const model::Quat& turn = {}) {
    body = support::add_solid(model, 1, "mover", shape, size, 1, position, turn);
    return static_cast<int>(model.geoms.size()) - 1;
  }
  /// What is left of one contact of the moving geom with a static one.
  std::vector<model::Contact> corrected(int tile, int mover, const Vec3& position, const Vec3& normal,
                                        double depth, double least_depth = 0) const {
    model::Contact contact;
    contact.body_a = body;
    contact.position = position;
    contact.normal = normal.normalized();
    contact.depth = depth;
    contact.geoms = {std::min(tile, mover), std::max(tile, mover)};
    std::vector<model::Contact> contacts = {contact};
    const auto seams = Seams::find(model);
    if (seams)
      seams->correct(
          0, least_depth, [&](int index) { return body_pose(model.bodies[index].pose); }, contacts);
    return contacts;
  }
};

/// Two tiles side by side whose tops are at z = 0, the seam at x = 0.
struct TwoTiles : Scene {
  int left, right;
  explicit TwoTiles(double step = 0, double gap = 0)
      : left(tile({1, 1, 0.2}, {-0.5, 0, -0.1})), right(tile({1, 1, 0.2}, {0.5 + gap, 0, -0.1 + step})) {}
};

void expect_unchanged(const std::vector<model::Contact>& contacts, const Vec3& normal, double depth) {
  ASSERT_EQ(contacts.size(), 1u);
  EXPECT_EQ(contacts[0].normal, normal.normalized());
  EXPECT_EQ(contacts[0].depth, depth);
}

TEST(Seams, are_absent_where_no_static_geoms_touch) {
  Scene apart;
  apart.tile({1, 1, 1}, {0, 0, 0});
  apart.tile({1, 1, 1}, {1.0002, 0, 0});  // twice the tolerance
  EXPECT_EQ(Seams::find(apart.model), nullptr);
  Scene near;
  near.tile({1, 1, 1}, {0, 0, 0});
  near.tile({1, 1, 1}, {1.00005, 0, 0});
  EXPECT_NE(Seams::find(near.model), nullptr);
}

TEST(Seams, take_a_box_on_the_ground_as_one_solid_with_it) {
  Scene scene;
  support::add_ground(scene.model);
  scene.tile({1, 1, 1}, {0, 0, 0.5});
  EXPECT_NE(Seams::find(scene.model), nullptr);
}

TEST(Seams, leave_bodies_without_flush_geoms_as_they_are) {
  const auto body_of = [](double width) {
    Scene scene;
    const int geom = scene.mover(Shape::box, {1, 1, 0.2}, {0, 0, 1});
    model::Geom other = scene.model.geoms[static_cast<std::size_t>(geom)];
    other.local.position = {0, 0, 0.2};
    other.size = {width, 0.6, 0.2};
    scene.model.geoms.push_back(other);
    return Seams::find(scene.model) != nullptr;
  };
  EXPECT_FALSE(body_of(0.6));  // a cabin
  EXPECT_TRUE(body_of(1));     // its front and back are flush with those of the lower box
}

TEST(Seams, drop_the_side_of_a_flush_tile_ahead_of_a_box) {
  TwoTiles tiles;
  const int box = tiles.mover(Shape::box, {0.2, 0.2, 0.2}, {-0.1005, 0, 0.099999});
  EXPECT_TRUE(tiles.corrected(tiles.right, box, {0, 0, -1e-6}, -Vec3::UnitX(), -0.0005, -0.001).empty());
}

TEST(Seams, put_a_box_that_has_sunk_across_a_seam_on_the_top_of_the_tile) {
  TwoTiles tiles;
  const double sunk = 0.04, over = 0.02;  // overlaps less from the side
  const int box = tiles.mover(Shape::box, {0.2, 0.3, 0.2}, {over - 0.1, 0.03, 0.1 - sunk});
  const auto contacts = tiles.corrected(tiles.right, box, {over, 0, -0.02}, -Vec3::UnitX(), over);
  ASSERT_EQ(contacts.size(), 4u);
  for (const model::Contact& contact : contacts) {
    EXPECT_EQ(contact.normal, Vec3::UnitZ());
    EXPECT_NEAR(contact.depth, sunk, 1e-15);  // some roundings of numbers below 1
    EXPECT_NEAR(contact.position.z(), -sunk / 2, 1e-15);
    EXPECT_TRUE(std::abs(contact.position.x()) < 1e-15 || std::abs(contact.position.x() - over) < 1e-15);
    EXPECT_NEAR(std::abs(contact.position.y() - 0.03), 0.15, 1e-15);
    EXPECT_EQ(contact.body_a, tiles.body);
  }
}

TEST(Seams, drop_the_skewed_contact_of_a_ball_with_the_edge_of_the_next_tile) {
  TwoTiles tiles;
  const int ball = tiles.mover(Shape::sphere, {0.1, 0, 0}, {-0.01, 0, 0.0995});
  EXPECT_TRUE(tiles.corrected(tiles.right, ball, {0, 0, 0}, {-0.1, 0, 1}, 1e-6).empty());
  expect_unchanged(tiles.corrected(tiles.left, ball, {-0.01, 0, 0}, Vec3::UnitZ(), 5e-4), Vec3::UnitZ(),
                   5e-4);
}

TEST(Seams, turn_the_skewed_contact_of_a_box_edge_up_where_the_box_lies_on_the_tile) {
  TwoTiles tiles;
  const int box = tiles.mover(Shape::box, {0.2, 0.2, 0.2}, {0, 0, 0.0999});
  const auto contacts = tiles.corrected(tiles.right, box, {0, 0, 0}, {-0.05, 0, 1}, 1e-4);
  ASSERT_EQ(contacts.size(), 4u);
  for (const model::Contact& contact : contacts) {
    EXPECT_EQ(contact.normal, Vec3::UnitZ());
    EXPECT_NEAR(contact.depth, 1e-4, 1e-15);
    EXPECT_GE(contact.position.x(), 0);
  }
}

TEST(Seams, keep_a_step_and_the_edge_on_top_of_it) {
  TwoTiles tiles(0.005);
  const int box = tiles.mover(Shape::box, {0.2, 0.2, 0.2}, {-0.0995, 0, 0.1 - 1e-5});
  expect_unchanged(tiles.corrected(tiles.right, box, {0, 0.1, -1e-5}, -Vec3::UnitX(), 5e-4), -Vec3::UnitX(),
                   5e-4);
  expect_unchanged(tiles.corrected(tiles.right, box, {0, 0, 0.005}, {-1, 0, 1}, 1e-4), {-1, 0, 1}, 1e-4);
}

TEST(Seams, take_a_step_within_the_tolerance_as_none) {
  TwoTiles tiles(0.00009, 0.00009);
  const int box = tiles.mover(Shape::box, {0.2, 0.2, 0.2}, {-0.0995, 0, 0.1});
  const auto contacts = tiles.corrected(tiles.right, box, {0, 0.1, 0}, -Vec3::UnitX(), 4.1e-4, -1e-3);
  ASSERT_EQ(contacts.size(), 4u);
  for (const model::Contact& contact : contacts) {
    EXPECT_EQ(contact.normal, Vec3::UnitZ());
    EXPECT_NEAR(contact.depth, 0.00009, 1e-15);
  }
}

TEST(Seams, keep_the_outer_edge_of_a_floor) {
  TwoTiles tiles;
  const int ball = tiles.mover(Shape::sphere, {0.1, 0, 0}, {1.05, 0, 0.05});
  expect_unchanged(tiles.corrected(tiles.right, ball, {1, 0, 0}, {1, 0, 1}, 1e-3), {1, 0, 1}, 1e-3);
  // At the corner where the seam ends the normal must not lean across the seam.
  EXPECT_TRUE(tiles.corrected(tiles.right, ball, {0, 0.5, 0}, {-0.1, 1, 1}, 1e-3).empty());
}

TEST(Seams, allow_at_the_ridge_of_two_slopes_the_normals_between_those_of_both) {
  const double tilt = 0.1;
  Scene scene;
  const auto slab = [&](double side) {
    const model::Quat turn = support::rotation(Vec3::UnitY(), side * tilt);
    const core::Pose pose{{0, 0, 0}, turn};
    return scene.tile({1, 1, 0.2}, pose.direction_to_outer({side * 0.5, 0, -0.1}), turn);
  };
  slab(-1);
  const int right = slab(1);
  const int ball = scene.mover(Shape::sphere, {0.1, 0, 0}, {0, 0, 0.0999});
  for (const double lean : {-0.09, 0.0, 0.09}) {
    const Vec3 normal(std::sin(lean), 0, std::cos(lean));
    expect_unchanged(scene.corrected(right, ball, {0, 0, 0}, normal, 1e-4), normal, 1e-4);
  }
  const Vec3 beyond(-std::sin(0.2), 0, std::cos(0.2));
  EXPECT_TRUE(scene.corrected(right, ball, {0, 0, 0}, beyond, 1e-4).empty());
}

TEST(Seams, cover_a_point_exactly_where_a_neighbour_is_in_front_of_it) {
  Scene scene;
  const int low = scene.tile({4, 4, 1}, {0, 0, -0.5});
  std::vector<std::array<double, 2>> bricks;
  for (int i = 0; i < 40; ++i) {
    const double x = core::to_unit(core::mix_key(1, i, 0)) * 3 - 1.5;
    const double y = core::to_unit(core::mix_key(2, i, 0)) * 3 - 1.5;
    bricks.push_back({x, y});
    scene.tile({0.3, 0.2, 0.1 + 0.01 * i}, {x, y, 0.05 + 0.005 * i});
  }
  const auto seams = Seams::find(scene.model);
  ASSERT_NE(seams, nullptr);
  int covered = 0;
  for (int i = 0; i < 2000; ++i) {
    const Vec3 point(core::to_unit(core::mix_key(3, i, 0)) * 4 - 2,
                     core::to_unit(core::mix_key(4, i, 0)) * 4 - 2, 0);
    bool inside = false, at_border = false;
    for (const auto& brick : bricks) {
      const double beyond =
          std::max(std::abs(point.x() - brick[0]) - 0.15, std::abs(point.y() - brick[1]) - 0.1);
      inside |= beyond < 0;
      at_border |= std::abs(beyond) < 2e-4;
    }
    if (at_border) continue;
    covered += inside;
    EXPECT_EQ(seams->covers(low, static_pose(), point, Vec3::UnitZ()), inside);
  }
  EXPECT_GT(covered, 200);
}

TEST(LieOnFace, cuts_a_turned_box_at_the_border_of_the_face) {
  model::Geom plate, box;
  plate.size = {2, 2, 1};
  box.size = {1, 1, 1};
  const Solid below = solid_at(plate, body_pose({{0, 0, -0.5}, {}}));
  const double sunk = 0.01;
  // A square turned by 45 degrees about the plate's right border: its left half is a triangle.
  const Solid above =
      solid_at(box, body_pose({{1, 0, 0.5 - sunk}, support::rotation(Vec3::UnitZ(), std::acos(-1.0) / 4)}));
  const FacePoints points = lie_on_face(above, below, {2, 1}, 0);
  ASSERT_EQ(points.count, 3);
  const double half = std::sqrt(0.5);
  for (const FacePoint& point : points) {
    EXPECT_NEAR(point.depth, sunk, 1e-15);
    const bool tip =
        std::abs(point.position.x() - (1 - half)) < 1e-15 && std::abs(point.position.y()) < 1e-15;
    const bool base =
        std::abs(point.position.x() - 1) < 1e-15 && std::abs(std::abs(point.position.y()) - half) < 1e-15;
    EXPECT_TRUE(tip || base) << point.position.transpose();
  }
}

TEST(LieOnFace, gives_a_lying_capsule_both_ends_and_a_standing_cylinder_four_points) {
  model::Geom plate, capsule, cylinder;
  plate.size = {2, 2, 1};
  capsule.shape = Shape::capsule;
  capsule.size = {0.1, 0.6, 0};
  cylinder.shape = Shape::cylinder;
  cylinder.size = {0.2, 0.5, 0};
  const Solid below = solid_at(plate, body_pose({{0, 0, -0.5}, {}}));
  const model::Quat lying = support::rotation(Vec3::UnitY(), std::acos(-1.0) / 2);
  const FacePoints line = lie_on_face(solid_at(capsule, body_pose({{0, 0, 0.09}, lying})), below, {2, 1}, 0);
  ASSERT_EQ(line.count, 2);
  for (const FacePoint& point : line) {
    EXPECT_NEAR(std::abs(point.position.x()), 0.3, 1e-15);
    EXPECT_NEAR(point.depth, 0.01, 1e-15);
  }
  const FacePoints disc = lie_on_face(solid_at(cylinder, body_pose({{0, 0, 0.24}, {}})), below, {2, 1}, 0);
  ASSERT_EQ(disc.count, 4);
  for (const FacePoint& point : disc) {
    EXPECT_NEAR(point.position.head<2>().norm(), 0.2, 1e-15);
    EXPECT_NEAR(point.depth, 0.01, 1e-15);
  }
}

}  // namespace
}  // namespace pbmpi::geometry
