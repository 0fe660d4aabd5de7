#include "geometry/ray_cast.h"

#include <cmath>

#include <gtest/gtest.h>

#include "core/random.h"
#include "geometry/geometry.h"
#include "support/models.h"

namespace pbmpi::geometry {
namespace {

model::Geom solid(model::Shape shape, const std::array<double, 3>& size) {
  model::Geom geom;
  geom.shape = shape;
  geom.size = size;
  return geom;
}

model::BodyPose placed(const core::Vec3& position, const core::Quat& q = {}) {
  return body_pose({position, q});
}

void expect_entry(const model::Geom& geom, const model::BodyPose& pose, const core::Vec3& from,
                  const core::Vec3& way, double share, const core::Vec3& normal) {
  const auto entry = enter(geom, pose, from, way);
  ASSERT_TRUE(entry);
  // Some ten roundings of numbers near 1.
  EXPECT_NEAR(entry->share, share, 1e-14);
  EXPECT_LT((entry->normal - normal).norm(), 1e-14);
}

TEST(Enter, finds_the_face_of_each_shape_at_its_known_distance) {
  const core::Vec3 from(-3, 0, 0), way(4, 0, 0), back(-1, 0, 0);
  expect_entry(solid(model::Shape::sphere, {0.5, 0, 0}), placed(core::Vec3::Zero()), from, way, 2.5 / 4,
               back);
  expect_entry(solid(model::Shape::box, {1, 2, 3}), placed(core::Vec3::Zero()), from, way, 2.5 / 4, back);
  expect_entry(solid(model::Shape::capsule, {0.5, 2, 0}), placed(core::Vec3::Zero()), from, way, 2.5 / 4,
               back);
  expect_entry(solid(model::Shape::cylinder, {0.5, 2, 0}), placed(core::Vec3::Zero()), from, way, 2.5 / 4,
               back);
  const core::Quat lying = support::rotation(core::Vec3::UnitY(), std::acos(-1.0) / 2);  // turns z to x
  expect_entry(solid(model::Shape::capsule, {0.5, 2, 0}), placed(core::Vec3::Zero(), lying), from, way,
               1.5 / 4, back);
  expect_entry(solid(model::Shape::cylinder, {0.5, 2, 0}), placed(core::Vec3::Zero(), lying), from, way,
               2.0 / 4, back);
  expect_entry(solid(model::Shape::plane, {}),
               placed({-1, 7, 7}, support::rotation(core::Vec3::UnitY(), -std::acos(0.0))), from, way,
               2.0 / 4, back);
}

TEST(Enter, finds_the_normal_at_a_slant) {
  // A chord at height 0.3 of a ball of radius 0.5: it enters 0.4 before the middle.
  expect_entry(solid(model::Shape::sphere, {0.5, 0, 0}), placed({1, 1, 1}), {0, 1, 1.3}, {2, 0, 0}, 0.6 / 2,
               {-0.8, 0, 0.6});
  // The same chord on the cap of a capsule whose middle is 1 m below.
  expect_entry(solid(model::Shape::capsule, {0.5, 2, 0}), placed({1, 1, 0}), {0, 1, 1.3}, {2, 0, 0}, 0.6 / 2,
               {-0.8, 0, 0.6});
  // Down through the end of a cylinder, and through the top of a plate at an angle of 45 degrees.
  expect_entry(solid(model::Shape::cylinder, {0.5, 2, 0}), placed(core::Vec3::Zero()), {0.2, 0.1, 2},
               {0, 0, -2}, 0.5, {0, 0, 1});
  expect_entry(solid(model::Shape::box, {10, 10, 0.1}), placed(core::Vec3::Zero()), {0, 0, 1.05}, {2, 0, -2},
               0.5, {0, 0, 1});
}

TEST(Enter, finds_nothing_that_is_missed_left_or_beyond_the_way) {
  for (const model::Geom& geom :
       {solid(model::Shape::sphere, {0.5, 0, 0}), solid(model::Shape::box, {1, 1, 1}),
        solid(model::Shape::capsule, {0.5, 1, 0}), solid(model::Shape::cylinder, {0.5, 1, 0})}) {
    const model::BodyPose pose = placed(core::Vec3::Zero());
    EXPECT_FALSE(enter(geom, pose, {-3, 0, 0}, {2.4, 0, 0})) << "ends before it";
    EXPECT_FALSE(enter(geom, pose, {-3, 0, 1.1}, {6, 0, 0})) << "passes above";
    EXPECT_FALSE(enter(geom, pose, {0.1, 0, 0}, {3, 0, 0})) << "starts inside";
    EXPECT_FALSE(enter(geom, pose, {1, 0, 0}, {3, 0, 0})) << "moves away";
    EXPECT_FALSE(enter(geom, pose, {-3, 0, 0}, {0, 0, 0})) << "does not move";
    EXPECT_FALSE(enter(geom, pose, {-3, 0, 0}, {NAN, 0, 0})) << "is lost";
  }
  const model::Geom plane = solid(model::Shape::plane, {});
  EXPECT_FALSE(enter(plane, placed(core::Vec3::Zero()), {0, 0, 1}, {5, 0, 0})) << "along the plane";
  EXPECT_FALSE(enter(plane, placed(core::Vec3::Zero()), {0, 0, -1}, {0, 0, -1})) << "below the plane";
}

/// Does the geom contain the point, which is given in the geom's own frame?
bool holds(const model::Geom& geom, const core::Vec3& p) {
  const double across = std::hypot(p.x(), p.y());
  switch (geom.shape) {
    case model::Shape::sphere:
      return p.norm() <= geom.size[0];
    case model::Shape::box:
      return 2 * std::abs(p.x()) <= geom.size[0] && 2 * std::abs(p.y()) <= geom.size[1] &&
             2 * std::abs(p.z()) <= geom.size[2];
    case model::Shape::capsule:
      return std::hypot(across, std::max(0.0, std::abs(p.z()) - geom.size[1] / 2)) <= geom.size[0];
    case model::Shape::cylinder:
      return across <= geom.size[0] && 2 * std::abs(p.z()) <= geom.size[1];
    case model::Shape::plane:
      return p.z() <= 0;
    case model::Shape::hull:  // tests/geometry/hulls
    case model::Shape::mesh:
      break;
  }
  return false;
}

// Oracle: the path walked in 2,000 short steps.
TEST(Enter, agrees_with_walking_the_way_in_short_steps) {
  constexpr int num_steps = 2000;
  int num_hits = 0;
  for (std::uint64_t i = 0; i < 400; ++i) {
    const auto number = [&](std::uint64_t k) { return core::to_unit(core::mix_key(11, i, k)); };
    const auto vector = [&](std::uint64_t k, double side) {
      return core::Vec3(side *
                        (core::Vec3(number(k), number(k + 1), number(k + 2)) - core::Vec3::Constant(0.5)));
    };
    const model::Geom geom =
        solid(static_cast<model::Shape>(i % 4), {0.2 + number(0), 0.2 + number(1), 0.2 + number(2)});
    const core::Quat turn = support::rotation(vector(3, 1).normalized(), 6 * number(6));
    const core::Vec3 at = vector(7, 1), from = vector(10, 4);
    const core::Vec3 way = 2 * (vector(13, 1) - from);
    const Eigen::Quaterniond to_geom = turn.to_eigen().conjugate();
    const auto entry = enter(geom, placed(at, turn), from, way);
    double first = 2;
    for (int k = 0; k <= num_steps && first > 1; ++k) {
      const double share = static_cast<double>(k) / num_steps;
      if (holds(geom, to_geom * (from + share * way - at))) first = share;
    }
    if (first == 0) {
      EXPECT_FALSE(entry) << "starts inside";
    } else if (first <= 1) {
      ASSERT_TRUE(entry) << i;
      EXPECT_LE(entry->share, first) << i;
      EXPECT_GE(entry->share, first - 1.0 / num_steps - 1e-12) << i;
      EXPECT_LT(entry->normal.dot(way), 0) << i;
      ++num_hits;
    }  // otherwise the walk may have stepped over a corner
  }
  EXPECT_GT(num_hits, 100);
}

}  // namespace
}  // namespace pbmpi::geometry
