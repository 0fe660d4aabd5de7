#include "geometry/geometry.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "support/models.h"

namespace pbmpi::geometry {
namespace {

constexpr double rounding = 1e-12;

model::Geom geom_of(model::Shape shape, const std::array<double, 3>& size) {
  model::Geom geom;
  geom.shape = shape;
  geom.size = size;
  return geom;
}

TEST(BodyPose, has_the_place_and_the_rotation_by_rows) {
  const model::BodyPose pose =
      body_pose({{1, 2, 3}, support::rotation(core::Vec3::UnitY(), std::numbers::pi / 2)});  // turns z to x
  const double place[3] = {1, 2, 3}, rotation[9] = {0, 0, 1, 0, 1, 0, -1, 0, 0};
  for (int k = 0; k < 3; ++k) EXPECT_EQ(pose.position[k], place[k]);
  for (int k = 0; k < 9; ++k) EXPECT_NEAR(pose.rotation[k], rotation[k], rounding);
}

TEST(HalfExtent, is_known_along_the_axes_and_between_them) {
  double turned[9], straight[9];
  const core::Quat q =
      support::rotation(core::Vec3::UnitY(), std::numbers::pi / 4);  // z leans towards x by 45 degrees
  to_rotation(q.w, q.x, q.y, q.z, turned);
  to_rotation(1, 0, 0, 0, straight);
  const auto extent = [](model::Shape shape, const std::array<double, 3>& size, const double rotation[9],
                         const core::Vec3& direction) {
    return half_extent(geom_of(shape, size), rotation, direction);
  };
  const double root = std::sqrt(0.5);
  EXPECT_NEAR(extent(model::Shape::sphere, {0.3, 0, 0}, turned, core::Vec3::UnitX()), 0.3, rounding);
  EXPECT_NEAR(extent(model::Shape::box, {1, 2, 3}, straight, core::Vec3::UnitY()), 1, rounding);
  EXPECT_NEAR(extent(model::Shape::box, {1, 2, 3}, turned, core::Vec3::UnitX()), 2 * root, rounding);
  EXPECT_NEAR(extent(model::Shape::capsule, {0.3, 2, 0}, turned, core::Vec3::UnitX()), 0.3 + root, rounding);
  EXPECT_NEAR(extent(model::Shape::cylinder, {0.3, 2, 0}, turned, core::Vec3::UnitX()), 1.3 * root, rounding);
  EXPECT_NEAR(extent(model::Shape::cylinder, {0.3, 2, 0}, turned, core::Vec3::UnitY()), 0.3, rounding);
}

TEST(LeastHalfExtent, is_that_of_the_thinnest_direction) {
  EXPECT_EQ(least_half_extent(geom_of(model::Shape::sphere, {0.3, 0, 0})), 0.3);
  EXPECT_EQ(least_half_extent(geom_of(model::Shape::box, {1, 0.4, 3})), 0.2);
  EXPECT_EQ(least_half_extent(geom_of(model::Shape::capsule, {0.3, 2, 0})), 0.3);
  EXPECT_EQ(least_half_extent(geom_of(model::Shape::cylinder, {0.3, 2, 0})), 0.3);
  EXPECT_EQ(least_half_extent(geom_of(model::Shape::cylinder, {0.3, 0.2, 0})), 0.1);
}

TEST(BoundingRadius, holds_the_corners_and_rims) {
  EXPECT_EQ(bounding_radius(geom_of(model::Shape::sphere, {0.3, 0, 0})), 0.3);
  EXPECT_NEAR(bounding_radius(geom_of(model::Shape::box, {2, 4, 4})), 3, rounding);
  EXPECT_NEAR(bounding_radius(geom_of(model::Shape::capsule, {0.3, 2, 0})), 1.3, rounding);
  EXPECT_NEAR(bounding_radius(geom_of(model::Shape::cylinder, {3, 8, 0})), 5, rounding);
}

TEST(Extents, of_a_plane_have_no_end) {
  const model::Geom plane = geom_of(model::Shape::plane, {});
  const double straight[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
  EXPECT_EQ(bounding_radius(plane), model::infinity);
  EXPECT_EQ(least_half_extent(plane), model::infinity);
  EXPECT_EQ(half_extent(plane, straight, core::Vec3::UnitZ()), model::infinity);
  EXPECT_THROW(half_extents(plane, straight), std::logic_error);
}

}  // namespace
}  // namespace pbmpi::geometry
