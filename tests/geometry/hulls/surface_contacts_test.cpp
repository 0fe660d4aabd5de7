#include "geometry/hulls/surface_contacts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "geometry/ray_cast.h"
#include "shapes.h"

namespace pbmpi::geometry {
namespace {

using core::Vec3;
using model::Geom;
using model::Shape;

/// A grid of `cells` x `cells` cells of 1 m about the origin.
template <class Height>
PlacedMesh grid(int cells, const Height& height) {
  std::vector<Vec3> points;
  std::vector<std::array<int, 3>> triangles;
  for (int row = 0; row <= cells; ++row) {
    for (int column = 0; column <= cells; ++column) {
      const double x = column - 0.5 * cells, y = row - 0.5 * cells;
      points.emplace_back(x, y, height(x, y));
    }
  }
  for (int row = 0; row < cells; ++row) {
    for (int column = 0; column < cells; ++column) {
      const int at = row * (cells + 1) + column, above = at + cells + 1;
      triangles.push_back({at, at + 1, above});
      triangles.push_back({at + 1, above + 1, above});
    }
  }
  return triangle_mesh(points, triangles, "test");
}

Geom placed_geom(const PlacedMesh& placed) {
  Geom geom;
  put_mesh(placed.mesh, geom);
  geom.local.position = placed.centre;
  return geom;
}

std::vector<SurfacePoint> touch(const Geom& geom, const model::BodyPose& at, const Geom& mesh) {
  SurfaceContacts contacts(0, 4);
  const auto found = contacts.collide(geom, at, mesh, geom_pose(mesh, static_pose()));
  return {found.begin(), found.end()};
}

std::vector<Geom> solids() {
  return {geom_of(corners_of_box({1.1, 0.9, 0.4})), geom_of(Shape::box, {1.1, 0.9, 0.4}),
          geom_of(Shape::sphere, {0.2, 0, 0}), geom_of(Shape::capsule, {0.2, 0.8, 0}),
          geom_of(Shape::cylinder, {0.5, 0.4, 0})};
}

/// Wherever it is on a level mesh, a solid touches it as it touches a plane: no normal but the mesh's, and
/// the depth of its lowest point.
TEST(SurfaceContacts, of_a_level_mesh_are_those_of_a_plane) {
  const Geom mesh = placed_geom(grid(8, [](double, double) { return 0.0; }));
  for (const Geom& solid : solids()) {
    for (int i = 0; i < 500; ++i) {
      model::BodyPose at = pose_at(3 * (point(i, 7, 2) - Vec3::Ones()), i);
      const double reach = half_extent(solid, at.rotation, -Vec3::UnitZ());
      const double depth = 1e-3 + 0.05 * number(i, 3);
      at.position[2] = reach - depth;
      const auto found = touch(solid, at, mesh);
      ASSERT_FALSE(found.empty()) << static_cast<int>(solid.shape) << " " << i;
      double deepest = 0;
      for (const SurfacePoint& point : found) {
        EXPECT_EQ(point.normal, Vec3::UnitZ()) << static_cast<int>(solid.shape) << " " << i;
        deepest = std::max(deepest, point.at.depth);
      }
      // Corners of a cylinder's outline are eight.
      EXPECT_NEAR(deepest, depth, solid.shape == Shape::cylinder ? 0.04 : 1e-12) << i;
    }
  }
}

TEST(SurfaceContacts, of_a_box_that_stands_on_many_triangles_are_its_corners) {
  const Geom mesh = placed_geom(grid(8, [](double, double) { return 0.0; }));
  const Geom box = geom_of(Shape::box, {5, 3, 1});
  const auto found = touch(box, body_pose({{0.3, 0.2, 0.4999}, {}}), mesh);
  ASSERT_EQ(found.size(), 4u);
  for (const SurfacePoint& point : found) {
    EXPECT_NEAR(std::abs(point.at.position.x() - 0.3), 2.5, 1e-9);
    EXPECT_NEAR(std::abs(point.at.position.y() - 0.2), 1.5, 1e-9);
    EXPECT_NEAR(point.at.depth, 1e-4, 1e-12);
  }
}

/// A ball in a trench touches both of its sides, once each; on a ridge it touches the ridge once.
TEST(SurfaceContacts, of_a_ball_are_one_for_each_side) {
  const Geom ball = geom_of(Shape::sphere, {0.3, 0, 0});
  const Geom trench = placed_geom(grid(4, [](double x, double) { return std::abs(x); }));
  const double height = 0.3 * std::sqrt(2.0) - 1e-3;
  const auto both = touch(ball, body_pose({{0, 0.3, height}, {}}), trench);
  ASSERT_EQ(both.size(), 2u);
  EXPECT_NEAR(both[0].normal.x() * both[1].normal.x(), -0.5, 1e-12);
  const Geom ridge = placed_geom(grid(4, [](double x, double) { return -std::abs(x); }));
  const auto once = touch(ball, body_pose({{0.05, 0.3, 0.29}, {}}), ridge);
  ASSERT_EQ(once.size(), 1u);
  EXPECT_NEAR(once[0].normal.x(), 0.05 / std::sqrt(0.05 * 0.05 + 0.29 * 0.29), 1e-9);
}

/// Each solid that dips into hills by little is free of them once it has moved out along the normals.
TEST(SurfaceContacts, lead_out_of_hills) {
  const Geom mesh = placed_geom(
      grid(12, [](double x, double y) { return 0.6 * number(static_cast<int>(x * 40 + y + 5000), 11); }));
  for (const Geom& solid : solids()) {
    int touching = 0;
    for (int i = 0; i < 400; ++i) {
      model::BodyPose at = pose_at(3 * (point(i, 7, 2) - Vec3::Ones()), i);
      at.position[2] = 1.5;
      // Down to where it touches.
      for (int step = 0; step < 2000 && touch(solid, at, mesh).empty(); ++step) at.position[2] -= 1e-3;
      const auto found = touch(solid, at, mesh);
      ASSERT_FALSE(found.empty());
      ++touching;
      for (const SurfacePoint& point : found) {
        // The rims of cylinders are tried in steps.
        EXPECT_LT(point.at.depth, solid.shape == Shape::cylinder ? 0.04 : 5e-3)
            << static_cast<int>(solid.shape) << " " << i;
        EXPECT_GT(point.normal.z(), 0.3);
      }
    }
    EXPECT_EQ(touching, 400);
  }
}

TEST(TriangleMesh, is_hit_from_its_front_and_nowhere_slips_a_path_through) {
  const Geom mesh = placed_geom(grid(8, [](double x, double y) { return 0.1 * x * y; }));
  const model::BodyPose at = geom_pose(mesh, static_pose());
  for (int i = 0; i < 4000; ++i) {
    const bool along_an_edge = i % 2 == 0;
    Vec3 from = 3.5 * (2 * point(i, 5, 1) - Vec3::Ones());
    if (along_an_edge) from.x() = std::round(from.x());
    from.z() = 10;
    const auto hit = enter(mesh, at, from, Vec3(0, 0, -20));
    ASSERT_TRUE(hit) << i;
    EXPECT_NEAR(10 - 20 * hit->share, 0.1 * from.x() * from.y(), 0.05);
    EXPECT_GT(hit->normal.z(), 0);
    EXPECT_FALSE(enter(mesh, at, from - Vec3(0, 0, 20), Vec3(0, 0, 20)));
  }
}

TEST(TriangleMesh, without_triangles_or_with_too_many_is_refused) {
  const std::vector<Vec3> points = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  const std::vector<std::array<int, 3>> line = {{0, 1, 2}};
  EXPECT_THROW(triangle_mesh(points, {}, "here"), core::InputError);
  EXPECT_THROW(triangle_mesh(points, line, "here"), core::InputError);
  const std::vector<std::array<int, 3>> many(most_mesh_triangles + 1, {0, 1, 2});
  EXPECT_THROW(triangle_mesh(points, many, "here"), core::InputError);
}

}  // namespace
}  // namespace pbmpi::geometry
