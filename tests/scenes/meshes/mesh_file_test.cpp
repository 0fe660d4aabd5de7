#include "scenes/meshes/mesh_file.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "scenes/meshes/mesh_text.h"

namespace pbmpi::scenes {
namespace {

using core::Vec3;

std::string error_of(const std::string& text, const std::string& file) {
  try {
    read_mesh(text, file);
  } catch (const core::InputError& error) {
    return error.what();
  }
  return "";
}

/// A tetrahedron, with the corners of a triangle in each form that OBJ has.
const std::string tetrahedron =
    "# a comment\nv 0 0 0\nv 3 0 0 1.0\nv +0 3 0\r\nv 0 0 3e0\nvn 0 0 1\nf 1 3 2\nf 1/1 2/1 4/1\n"
    "f 1//1 4//1 3//1\nf -3/1/1 -2/1/1 -1/1/1\n";

TEST(MeshFile, reads_an_obj) {
  const Mesh mesh = read_mesh(tetrahedron, "a.obj");
  EXPECT_EQ(mesh.points.size(), 4u);
  ASSERT_EQ(mesh.triangles.size(), 4u);
  EXPECT_EQ(mesh.triangles[3], (std::array<int, 3>{1, 2, 3}));
}

TEST(MeshFile, joins_points_with_equal_coordinates) {
  const Mesh mesh = read_mesh(
      "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n"
      "facet normal 0 0 1\nouter loop\nvertex 1 0 0\nvertex 1 1 0\nvertex 0 1 "
      "0\nendloop\nendfacet\nendsolid\n",
      "a.STL");
  EXPECT_EQ(mesh.points.size(), 4u);
  EXPECT_EQ(mesh.triangles.size(), 2u);
}

TEST(MeshFile, says_what_is_wrong_and_where) {
  EXPECT_EQ(error_of("v 0 0 0\nv 1 zero 0\n", "a.obj"), "a.obj:2: 'zero' is not a number; correct it");
  EXPECT_EQ(error_of("v 0 0\n", "a.obj"), "a.obj:1: a point needs three numbers");
  EXPECT_EQ(error_of("v 0 0 0\nf 1 2 3\n", "a.obj"), "a.obj:2: there is no point '2'; correct the face");
  EXPECT_NE(error_of("v 0 0 inf\n", "a.obj").find("not finite"), std::string::npos);
  EXPECT_NE(error_of("solid a\nfacet\nvertex 0 0 0\n", "a.stl").find("truncated"), std::string::npos);
  EXPECT_NE(error_of("STL", "a.stl").find("not an STL"), std::string::npos);
  EXPECT_NE(error_of("", "a.obj").find("no triangles"), std::string::npos);
}

TEST(MeshText, keeps_the_points_of_the_hull_and_what_the_surface_encloses) {
  const std::string inside = "v 0.5 0.5 0.5\n";
  const MeshPoints read =
      read_mesh_text(mesh_text(read_mesh(tetrahedron + inside, "a.obj"), "a.obj"), "a.obj");
  EXPECT_EQ(read.points.size(), 4u);
  ASSERT_TRUE(read.enclosed);
  EXPECT_NEAR(read.enclosed->volume, 4.5, 1e-14);
  EXPECT_LT((read.enclosed->centre - Vec3(0.75, 0.75, 0.75)).norm(), 1e-14);
  EXPECT_NEAR(read.enclosed->moments(0, 0), 4.5 * 9 * (0.1 - 1.0 / 16), 1e-13);
  EXPECT_NEAR(read.enclosed->moments(0, 1), 4.5 * 9 * (0.05 - 1.0 / 16), 1e-13);
}

TEST(MeshText, passes_over_triangles_that_are_lines) {
  const std::string lines = "f 1 1 2\nf 3 2 2\nf 4 4 4\n";
  EXPECT_NEAR(
      read_mesh_text(mesh_text(read_mesh(tetrahedron + lines, "a.obj"), "a.obj"), "a.obj").enclosed->volume,
      4.5, 1e-14);
}

TEST(MeshText, knows_a_surface_that_is_not_closed) {
  const std::string open = tetrahedron.substr(0, tetrahedron.find("f -3"));
  EXPECT_FALSE(read_mesh_text(mesh_text(read_mesh(open, "a.obj"), "a.obj"), "a.obj").enclosed);
}

}  // namespace
}  // namespace pbmpi::scenes
