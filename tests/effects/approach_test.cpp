#include "effects/approach.h"

#include <gtest/gtest.h>

#include "geometry/geometry.h"
#include "geometry/triangle_mesh.h"

namespace pbmpi::effects {
namespace {

using core::Vec3;

/// A square of two triangles, 20 m wide, level, at the height of 1 m.
model::Geom square() {
  const std::vector<Vec3> points = {{-10, -10, 1}, {10, -10, 1}, {10, 10, 1}, {-10, 10, 1}};
  const std::vector<std::array<int, 3>> triangles = {{0, 1, 2}, {0, 2, 3}};
  const geometry::PlacedMesh placed = geometry::triangle_mesh(points, triangles, "test");
  model::Geom geom;
  geometry::put_mesh(placed.mesh, geom);
  geom.local.position = placed.centre;
  return geom;
}

double approach(const Vec3& centre, const Vec3& way) {
  model::Geom ball;
  ball.shape = model::Shape::sphere;
  ball.size = {0.2, 0, 0};
  const model::Geom mesh = square();
  return approach_to_static(ball, geometry::body_pose({centre, {}}), way, mesh,
                            geometry::geom_pose(mesh, geometry::static_pose()));
}

TEST(Approach, to_a_mesh_is_what_leads_into_its_triangles) {
  EXPECT_NEAR(approach({3, 2, 1.5}, {0.4, 0, -0.6}), 0.6, 1e-12);
  EXPECT_EQ(approach({3, 2, 1.2}, {1, 1, 0}), 0) << "it slides along";
  EXPECT_EQ(approach({3, 2, 1.2}, {0, 0, 1}), 0) << "it leaves";
  EXPECT_EQ(approach({3, 2, 9}, {0, 0, -1}), 0) << "it does not come near";
}

}  // namespace
}  // namespace pbmpi::effects
