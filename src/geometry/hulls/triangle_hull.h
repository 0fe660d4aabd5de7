/// The convex hull of points as triangles.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "core/vector.h"

namespace pbmpi::geometry {

/// A hull that grows point by point, always by the point that is farthest outside of it, as quickhull does
/// (C. B. Barber, D. P. Dobkin, H. Huhdanpaa, ACM Trans. Math. Software 22, 1996): where it may not have more
/// vertices, it leaves out what matters least. The same points in the same order give the same hull.
class TriangleHull {
 public:
  struct Triangle {
    std::array<int, 3> corners{};     ///< indices of points, counter-clockwise as seen from outside
    std::array<int, 3> neighbours{};  ///< beyond the edge from corner k to the next
    core::Vec3 normal = core::Vec3::Zero();
    double height = 0;  ///< [m] of its plane
    bool is_alive = true;
    std::vector<int> outside;  ///< points above it
  };

  /// `points` are borrowed. `tolerance` [m]: what sticks out by less is left out.
  TriangleHull(std::span<const core::Vec3> points, double tolerance);

  /// False if the points lie in one plane, or on a line, give or take the tolerance: then there is no hull.
  bool is_solid() const { return !triangles_.empty(); }
  void grow(int most_vertices);
  /// Some are not alive.
  const std::vector<Triangle>& triangles() const { return triangles_; }

 private:
  bool begin();
  int add_triangle(int a, int b, int c);
  void assign(const std::vector<int>& points, std::size_t first_triangle);
  bool add_point(int point, int seed);
  bool find_visible(int point, int seed, double most_below);
  bool find_border();
  double above(const Triangle& triangle, int point) const {
    return triangle.normal.dot(points_[static_cast<std::size_t>(point)]) - triangle.height;
  }

  /// An edge between a triangle that a point sees and one that it does not.
  struct BorderEdge {
    int from = 0, to = 0, beyond = 0;
  };

  std::span<const core::Vec3> points_;
  double tolerance_;
  std::vector<Triangle> triangles_;
  std::vector<int> visible_;
  std::vector<BorderEdge> border_;
};

}  // namespace pbmpi::geometry
