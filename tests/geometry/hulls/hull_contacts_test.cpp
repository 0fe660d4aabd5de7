#include "geometry/hulls/hull_contacts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

#include "geometry/ray_cast.h"
#include "shapes.h"

namespace pbmpi::geometry {
namespace {

using core::Vec3;
using model::Geom;
using model::Shape;

constexpr double margin = 1e-3;

double deepest(const ContactPoints& found) {
  double depth = -model::infinity;
  for (int i = 0; i < found.count; ++i)
    depth = std::max(depth, found.points[static_cast<std::size_t>(i)].depth);
  return depth;
}

/// Geoms of all shapes that a hull may meet, about as large as the hulls.
std::vector<Geom> others(int i) {
  return {geom_of(points_on_ball(4 + i % 20, i + 500, 0.5)), geom_of(Shape::box, {0.6, 0.8, 0.4}),
          geom_of(Shape::sphere, {0.3, 0, 0}), geom_of(Shape::capsule, {0.15, 0.6, 0}),
          geom_of(Shape::cylinder, {0.3, 0.6, 0})};
}

/// A pair that overlaps little is apart once one of them has moved by the depth found, and is not before.
TEST(HullContacts, have_the_depth_by_which_a_pair_overlaps) {
  HullContacts hulls(margin);
  std::array<int, 5> touching{};
  for (int i = 0; i < 3000; ++i) {
    const Geom hull = geom_of(points_on_ball(4 + i % 37, i, 0.5));
    const model::BodyPose at = pose_at(Vec3::Zero(), i);
    const Vec3 place = point(i, 40, 2) - Vec3::Ones();
    const std::vector<Geom> all = others(i);
    for (std::size_t kind = 0; kind < all.size(); ++kind) {
      model::BodyPose from = pose_at(place, i + 7777);
      const ContactPoints found = hulls.collide(all[kind], from, hull, at);
      const double depth = deepest(found);
      if (found.count == 0 || depth > 0.02) continue;
      ++touching[kind];
      EXPECT_NEAR(found.normal.norm(), 1, 1e-12);
      for (const double rest : {-1e-4, 1e-4}) {
        model::BodyPose moved = from;
        for (int k = 0; k < 3; ++k) moved.position[k] += (depth + rest) * found.normal[k];
        const double then = deepest(hulls.collide(all[kind], moved, hull, at));
        // The rims of cylinders are tried in steps.
        EXPECT_NEAR(then, -rest, kind == 4 ? 0.012 : 3e-4) << i << " with kind " << kind;
      }
    }
  }
  for (const int count : touching) EXPECT_GT(count, 50);
}

TEST(HullContacts, are_the_same_whichever_geom_comes_first) {
  HullContacts hulls(margin);
  for (int i = 0; i < 500; ++i) {
    const Geom hull = geom_of(points_on_ball(12, i, 0.5));
    const model::BodyPose at = pose_at(Vec3::Zero(), i), from = pose_at(point(i, 40, 1), i + 77);
    for (const Geom& other : others(i)) {
      if (other.shape == Shape::hull) continue;
      const ContactPoints one = hulls.collide(other, from, hull, at);
      const ContactPoints two = hulls.collide(hull, at, other, from);
      ASSERT_EQ(one.count, two.count);
      EXPECT_EQ(one.normal, -two.normal);
      for (std::size_t k = 0; k < static_cast<std::size_t>(one.count); ++k)
        EXPECT_EQ(one.points[k].position, two.points[k].position);
    }
  }
}

TEST(HullContacts, stand_on_a_plane_on_the_corners_of_a_face) {
  const Geom hull = geom_of(corners_of_box({0.4, 0.6, 0.2}));
  const ContactPoints found = HullContacts(0).collide(hull, body_pose({{1, 2, 0.0999}, {}}),
                                                      geom_of(Shape::plane, {}), static_pose());
  ASSERT_EQ(found.count, 4);
  EXPECT_EQ(found.normal, Vec3::UnitZ());
  for (const ContactPoint& point : found.points) {
    EXPECT_NEAR(point.depth, 1e-4, 1e-15);
    EXPECT_NEAR(point.position.z(), -0.5e-4, 1e-15);
  }
}

TEST(HullContacts, of_a_capsule_that_lies_on_a_face_are_two) {
  const Geom table = geom_of(corners_of_box({2, 2, 0.2})), capsule = geom_of(Shape::capsule, {0.1, 0.6, 0});
  const core::Quat lying{std::sqrt(0.5), 0, std::sqrt(0.5), 0};
  const ContactPoints found =
      HullContacts(0).collide(capsule, body_pose({{0, 0, 0.1999}, lying}), table, static_pose());
  ASSERT_EQ(found.count, 2);
  EXPECT_NEAR((found.points[0].position - found.points[1].position).norm(), 0.6, 1e-12);
  for (std::size_t k = 0; k < 2; ++k) EXPECT_NEAR(found.points[k].depth, 1e-4, 1e-12);
}

TEST(HullContacts, of_a_cylinder_are_a_line_on_its_side_and_four_points_on_its_end) {
  const Geom table = geom_of(corners_of_box({2, 2, 0.2})), drum = geom_of(Shape::cylinder, {0.3, 0.6, 0});
  const core::Quat lying{std::sqrt(0.5), 0, std::sqrt(0.5), 0};
  const ContactPoints side =
      HullContacts(0).collide(drum, body_pose({{0, 0, 0.3999}, lying}), table, static_pose());
  ASSERT_EQ(side.count, 2);
  EXPECT_NEAR(deepest(side), 1e-4, 1e-12);
  EXPECT_NEAR((side.points[0].position - side.points[1].position).norm(), 0.6, 1e-12);
  const ContactPoints end =
      HullContacts(0).collide(drum, body_pose({{0, 0, 0.3999}, {}}), table, static_pose());
  ASSERT_EQ(end.count, 4);
  EXPECT_NEAR(deepest(end), 1e-4, 1e-12);
}

/// Deep within, a ball leaves by the nearest face.
TEST(HullContacts, let_a_ball_out_that_is_inside) {
  const Geom hull = geom_of(corners_of_box({2, 2, 2})), ball = geom_of(Shape::sphere, {0.1, 0, 0});
  const ContactPoints found =
      HullContacts(0).collide(ball, body_pose({{0.2, 0.9, -0.3}, {}}), hull, static_pose());
  ASSERT_EQ(found.count, 1);
  EXPECT_LT((found.normal - Vec3::UnitY()).norm(), 1e-14);
  EXPECT_NEAR(found.points[0].depth, 0.2, 1e-14);
}

TEST(HullContacts, are_none_where_a_pose_is_not_finite) {
  const Geom hull = geom_of(corners_of_box({2, 2, 2}));
  const model::BodyPose lost = body_pose({{NAN, 0, 0}, {}});
  EXPECT_EQ(HullContacts(0).collide(hull, lost, hull, static_pose()).count, 0);
}

TEST(RayCast, enters_a_hull_where_it_enters_the_box) {
  const Geom hull = geom_of(corners_of_box({0.4, 0.6, 0.2})), box = geom_of(Shape::box, {0.4, 0.6, 0.2});
  for (int i = 0; i < 1000; ++i) {
    const model::BodyPose at = pose_at({0.1, 0.2, 0.3}, i);
    const Vec3 from = point(i, 3, 2) - Vec3::Ones(), way = point(i, 6, 4) - Vec3(2, 2, 2);
    const auto one = enter(hull, at, from, way), two = enter(box, at, from, way);
    ASSERT_EQ(one.has_value(), two.has_value());
    if (!one) continue;
    EXPECT_NEAR(one->share, two->share, 1e-12);
    EXPECT_LT((one->normal - two->normal).norm(), 1e-12);
  }
}

}  // namespace
}  // namespace pbmpi::geometry
