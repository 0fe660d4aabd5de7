#include "geometry/hulls/convex_hull.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/error.h"
#include "shapes.h"

namespace pbmpi::geometry {
namespace {

using core::Vec3;

std::string error_of(const std::vector<Vec3>& points) {
  try {
    convex_hull(points, usual_hull_vertices, "here");
  } catch (const core::InputError& error) {
    return error.what();
  }
  return "";
}

void expect_closed(const model::Hull& hull) {
  const auto count = [](const auto& list) { return static_cast<int>(list.size()); };
  EXPECT_EQ(count(hull.vertices) - count(hull.edges) + count(hull.faces), 2);  // Euler
  EXPECT_EQ(count(hull.corners), 2 * count(hull.edges));
  for (const model::Hull::Face& face : hull.faces) {
    EXPECT_GT(face.height, 0);
    for (const Vec3& vertex : hull.vertices) EXPECT_LE(face.normal.dot(vertex), face.height + 1e-15);
  }
}

TEST(ConvexHull, of_the_corners_of_a_box_is_the_box) {
  const Vec3 sides(1, 2, 3), centre(4, -5, 6);
  std::vector<Vec3> points = corners_of_box(sides);
  for (Vec3& point : points) point += centre;
  points.push_back(centre);                    // inside
  points.push_back(centre + Vec3(0.5, 0, 0));  // on a face
  points.push_back(centre + Vec3(0.5, 1, 0));  // on an edge
  const FoundHull found = convex_hull(points, usual_hull_vertices, "");
  expect_closed(*found.hull);
  EXPECT_EQ(found.hull->vertices.size(), 8u);
  EXPECT_EQ(found.hull->faces.size(), 6u);
  EXPECT_LT((found.centre - centre).norm(), 1e-14);
  EXPECT_EQ(found.left_out_m, 0);
  EXPECT_NEAR(found.hull->volume, 6, 1e-14);
  EXPECT_NEAR(found.hull->surface, 22, 1e-13);
  const Vec3 moments(6.0 / 12 * (4 + 9), 6.0 / 12 * (1 + 9), 6.0 / 12 * (1 + 4));
  EXPECT_LT((found.hull->inertia - core::Mat3(moments.asDiagonal())).norm(), 1e-13);
}

/// A tetrahedron whose edges from one corner are a, b, c along the axes: closed forms.
TEST(ConvexHull, of_a_tetrahedron_has_the_known_mass_properties) {
  const double a = 0.3, b = 0.7, c = 1.1;
  const FoundHull found =
      convex_hull(std::vector<Vec3>{{0, 0, 0}, {a, 0, 0}, {0, b, 0}, {0, 0, c}}, usual_hull_vertices, "");
  expect_closed(*found.hull);
  const double volume = a * b * c / 6;
  EXPECT_NEAR(found.hull->volume, volume, 1e-16);
  EXPECT_LT((found.centre - Vec3(a, b, c) / 4).norm(), 1e-15);
  // Integral of x^2 about the centre: V a^2 (1/10 - 1/16); of x y: V a b (1/20 - 1/16).
  core::Mat3 moments;
  const Vec3 s(a, b, c);
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) moments(i, j) = volume * s[i] * s[j] * ((i == j ? 0.1 : 0.05) - 1.0 / 16);
  }
  const core::Mat3 inertia = moments.trace() * core::Mat3::Identity() - moments;
  EXPECT_LT((found.hull->inertia - inertia).norm(), 1e-15);
}

TEST(ConvexHull, of_many_points_keeps_those_that_matter_most) {
  const std::vector<Vec3> points = points_on_ball(5000, 3, 2);
  double before = 10;
  for (const int most : {4, 8, 16, 64, 256}) {
    const FoundHull found = convex_hull(points, most, "");
    expect_closed(*found.hull);
    EXPECT_LE(found.hull->vertices.size(), static_cast<std::size_t>(most));
    EXPECT_LT(found.left_out_m, before);
    before = found.left_out_m;
  }
  EXPECT_LT(before, 0.04);
  EXPECT_NEAR(convex_hull(points, 256, "").hull->volume, 4.0 / 3 * std::numbers::pi * 8, 1);
}

/// The faces of a part that was drawn in a CAD program and turned are flat only to within single precision.
TEST(ConvexHull, takes_faces_as_flat_that_single_precision_has_bent) {
  for (int variant = 0; variant < 20; ++variant) {
    const model::BodyPose pose = pose_at({0.3, 0.2, 0.1}, variant);
    const Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>> turn(pose.rotation);
    std::vector<Vec3> points;
    for (int i = 0; i < 1000; ++i) {
      const Vec3 at(i % 10, i / 10 % 10, i / 100);
      points.push_back((turn * (0.1 * at)).cast<float>().cast<double>());
    }
    const FoundHull found = convex_hull(points, usual_hull_vertices, "");
    expect_closed(*found.hull);
    EXPECT_EQ(found.hull->faces.size(), 6u) << variant;
    EXPECT_LT(found.left_out_m, 1e-6);
  }
}

TEST(ConvexHull, has_a_disc_as_one_face) {
  std::vector<Vec3> points;
  constexpr int sides = 100;
  for (int i = 0; i < sides; ++i) {
    const double angle = 2 * std::numbers::pi * i / sides;
    for (const double z : {0.0, 1.0}) points.emplace_back(std::cos(angle), std::sin(angle), z);
  }
  const FoundHull found = convex_hull(points, 256, "");
  expect_closed(*found.hull);
  EXPECT_EQ(found.hull->faces.size(), sides + 2u);
  EXPECT_NEAR(found.hull->volume, 0.5 * sides * std::sin(2 * std::numbers::pi / sides), 1e-9);
}

TEST(ConvexHull, says_why_points_have_none) {
  EXPECT_EQ(error_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}),
            "here: a hull needs at least 4 points, and there are 3; give more");
  EXPECT_NE(error_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}).find("in one plane"), std::string::npos);
  EXPECT_NE(error_of({{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {3, 3, 3}}).find("in one plane"), std::string::npos);
  EXPECT_NE(error_of({{1, 1, 1}, {1, 1, 1}, {1, 1, 1}, {1, 1, 1}}).find("in one plane"), std::string::npos);
  EXPECT_NE(error_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, NAN}}).find("not finite"), std::string::npos);
}

}  // namespace
}  // namespace pbmpi::geometry
