#include "geometry/hulls/triangle_hull.h"

#include <algorithm>

namespace pbmpi::geometry {
namespace {

/// Index of the first point with the largest value.
template <class Value>
int farthest(std::span<const core::Vec3> points, const Value& value) {
  int best = 0;
  double most = value(points[0]);
  for (std::size_t i = 1; i < points.size(); ++i) {
    const double one = value(points[i]);
    if (!(one > most)) continue;
    most = one;
    best = static_cast<int>(i);
  }
  return best;
}

}  // namespace

TriangleHull::TriangleHull(std::span<const core::Vec3> points, double tolerance)
    : points_(points), tolerance_(tolerance) {
  if (points.size() < 4 || !begin()) triangles_.clear();
}

/// Begins with four points that are far from each other.
bool TriangleHull::begin() {
  const auto at = [&](int i) -> const core::Vec3& { return points_[static_cast<std::size_t>(i)]; };
  const int a = farthest(points_, [](const core::Vec3& p) { return -p.x(); });
  const int b = farthest(points_, [&](const core::Vec3& p) { return (p - at(a)).squaredNorm(); });
  const core::Vec3 along = at(b) - at(a);
  if (!(along.norm() > tolerance_)) return false;
  const core::Vec3 line = along.normalized();
  const int c = farthest(points_, [&](const core::Vec3& p) { return (p - at(a)).cross(line).squaredNorm(); });
  const core::Vec3 normal = along.cross(at(c) - at(a));
  if (!((at(c) - at(a)).cross(line).norm() > tolerance_)) return false;
  const core::Vec3 up = normal.normalized();
  const int d = farthest(points_, [&](const core::Vec3& p) { return std::abs(up.dot(p - at(a))); });
  const double height = up.dot(at(d) - at(a));
  if (!(std::abs(height) > tolerance_)) return false;
  const int second = height > 0 ? c : b, third = height > 0 ? b : c;  // so that d is below a, second, third
  add_triangle(a, second, third);
  add_triangle(a, d, second);
  add_triangle(second, d, third);
  add_triangle(third, d, a);
  triangles_[0].neighbours = {1, 2, 3};
  triangles_[1].neighbours = {3, 2, 0};
  triangles_[2].neighbours = {1, 3, 0};
  triangles_[3].neighbours = {2, 1, 0};
  std::vector<int> all(points_.size());
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<int>(i);
  assign(all, 0);
  return true;
}

int TriangleHull::add_triangle(int a, int b, int c) {
  const core::Vec3& origin = points_[static_cast<std::size_t>(a)];
  const core::Vec3 across =
      (points_[static_cast<std::size_t>(b)] - origin).cross(points_[static_cast<std::size_t>(c)] - origin);
  Triangle triangle;
  triangle.corners = {a, b, c};
  triangle.normal = across / std::max(across.norm(), 1e-300);
  triangle.height = triangle.normal.dot(origin);
  triangles_.push_back(std::move(triangle));
  return static_cast<int>(triangles_.size()) - 1;
}

/// Gives each point that is outside to the triangle, of those from the first on, above which it is highest.
void TriangleHull::assign(const std::vector<int>& points, std::size_t first_triangle) {
  for (const int point : points) {
    double most = tolerance_;
    Triangle* best = nullptr;
    for (std::size_t i = first_triangle; i < triangles_.size(); ++i) {
      const double height = above(triangles_[i], point);
      if (!(height > most)) continue;
      most = height;
      best = &triangles_[i];
    }
    if (best != nullptr) best->outside.push_back(point);
  }
}

void TriangleHull::grow(int most_vertices) {
  for (int vertices = 4; vertices < most_vertices;) {
    double most = 0;
    int seed = -1, point = -1;
    for (std::size_t i = 0; i < triangles_.size(); ++i) {
      if (!triangles_[i].is_alive) continue;
      for (const int one : triangles_[i].outside) {
        const double height = above(triangles_[i], one);
        if (!(height > most)) continue;
        most = height;
        seed = static_cast<int>(i);
        point = one;
      }
    }
    if (seed < 0) return;
    if (add_point(point, seed))
      ++vertices;
    else
      std::erase(triangles_[static_cast<std::size_t>(seed)].outside, point);
  }
}

/// A triangle in whose plane the point lies goes, too, so that none becomes a line. Where rounding makes the
/// rest of the hull no surface with one border, only triangles that the point clearly sees go.
bool TriangleHull::add_point(int point, int seed) {
  if (!(find_visible(point, seed, tolerance_) && find_border()) &&
      !(find_visible(point, seed, 0) && find_border()))
    return false;
  std::vector<int> outside;
  for (const int index : visible_) {
    Triangle& triangle = triangles_[static_cast<std::size_t>(index)];
    outside.insert(outside.end(), triangle.outside.begin(), triangle.outside.end());
    triangle.is_alive = false;
    triangle.outside = {};
  }
  std::erase(outside, point);
  const std::size_t first = triangles_.size();
  const int count = static_cast<int>(border_.size());
  for (int i = 0; i < count; ++i) {
    const BorderEdge& edge = border_[static_cast<std::size_t>(i)];
    const int index = add_triangle(edge.from, edge.to, point);
    const int begin = static_cast<int>(first);
    triangles_.back().neighbours = {edge.beyond, begin + (i + 1) % count, begin + (i + count - 1) % count};
    Triangle& beyond = triangles_[static_cast<std::size_t>(edge.beyond)];
    for (std::size_t k = 0; k < 3; ++k) {
      if (beyond.corners[k] == edge.to && beyond.corners[(k + 1) % 3] == edge.from)
        beyond.neighbours[k] = index;
    }
  }
  assign(outside, first);
  return true;
}

/// Finds the connected triangles from `seed` on above which the point lies, or at most so far below.
bool TriangleHull::find_visible(int point, int seed, double most_below) {
  visible_.assign(1, seed);
  for (std::size_t i = 0; i < visible_.size(); ++i) {
    for (const int next : triangles_[static_cast<std::size_t>(visible_[i])].neighbours) {
      if (std::find(visible_.begin(), visible_.end(), next) != visible_.end()) continue;
      if (above(triangles_[static_cast<std::size_t>(next)], point) > -most_below) visible_.push_back(next);
    }
  }
  return true;
}

/// Finds the border of the visible triangles as one loop. False if there are several, or if it meets itself.
bool TriangleHull::find_border() {
  std::vector<BorderEdge> edges;
  for (const int index : visible_) {
    const Triangle& triangle = triangles_[static_cast<std::size_t>(index)];
    for (std::size_t k = 0; k < 3; ++k) {
      const int beyond = triangle.neighbours[k];
      if (std::find(visible_.begin(), visible_.end(), beyond) == visible_.end())
        edges.push_back({triangle.corners[k], triangle.corners[(k + 1) % 3], beyond});
    }
  }
  border_.clear();
  if (edges.size() < 3) return false;
  BorderEdge next = edges.front();
  while (border_.size() < edges.size()) {
    border_.push_back(next);
    const auto leaves = [&](const BorderEdge& edge) { return edge.from == next.to; };
    if (std::count_if(edges.begin(), edges.end(), leaves) != 1) return false;
    next = *std::find_if(edges.begin(), edges.end(), leaves);
    if (next.from == edges.front().from && border_.size() < edges.size()) return false;
  }
  return next.from == edges.front().from;
}

}  // namespace pbmpi::geometry
