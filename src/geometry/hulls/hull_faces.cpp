#include "geometry/hulls/hull_faces.h"

#include <algorithm>
#include <map>

#include "core/error.h"

namespace pbmpi::geometry {
namespace {

using Loop = std::vector<int>;  // indices of points

/// Joins triangles to faces, beginning with the largest.
class FaceFinder {
 public:
  FaceFinder(const TriangleHull& hull, std::span<const core::Vec3> points, double tolerance)
      : triangles_(hull.triangles()), points_(points), tolerance_(tolerance), face_(triangles_.size(), -1) {}

  std::vector<Loop> find() {
    std::vector<std::pair<double, int>> by_area;
    for (std::size_t i = 0; i < triangles_.size(); ++i) {
      if (triangles_[i].is_alive) by_area.emplace_back(-area(triangles_[i]), static_cast<int>(i));
    }
    std::sort(by_area.begin(), by_area.end());
    for (const auto& [size, seed] : by_area) {
      if (face_[static_cast<std::size_t>(seed)] < 0) add_face(seed);
    }
    drop_corners_on_edges();
    return std::move(loops_);
  }

 private:
  using Triangle = TriangleHull::Triangle;

  const Triangle& at(int i) const { return triangles_[static_cast<std::size_t>(i)]; }
  const core::Vec3& point(int i) const { return points_[static_cast<std::size_t>(i)]; }

  double area(const Triangle& one) const {
    return (point(one.corners[1]) - point(one.corners[0]))
        .cross(point(one.corners[2]) - point(one.corners[0]))
        .norm();
  }

  bool is_flush(const Triangle& one, const Triangle& seed) const {
    return one.normal.dot(seed.normal) > 0 && std::ranges::all_of(one.corners, [&](int corner) {
             return std::abs(seed.normal.dot(point(corner)) - seed.height) <= tolerance_;
           });
  }

  void add_face(int seed) {
    const int number = static_cast<int>(loops_.size());
    std::vector<int> joined{seed};
    face_[static_cast<std::size_t>(seed)] = number;
    for (std::size_t i = 0; i < joined.size(); ++i) {
      for (const int next : at(joined[i]).neighbours) {
        if (face_[static_cast<std::size_t>(next)] >= 0 || !is_flush(at(next), at(seed))) continue;
        face_[static_cast<std::size_t>(next)] = number;
        joined.push_back(next);
      }
    }
    Loop loop = border(joined, number);
    if (loop.empty()) {  // the border meets itself: the triangle stays alone
      for (const int one : joined) face_[static_cast<std::size_t>(one)] = -1;
      face_[static_cast<std::size_t>(seed)] = number;
      loop.assign(at(seed).corners.begin(), at(seed).corners.end());
    }
    loops_.push_back(std::move(loop));
  }

  Loop border(const std::vector<int>& joined, int number) const {
    std::map<int, int> next;
    for (const int one : joined) {
      for (std::size_t k = 0; k < 3; ++k) {
        if (face_[static_cast<std::size_t>(at(one).neighbours[k])] == number) continue;
        if (!next.emplace(at(one).corners[k], at(one).corners[(k + 1) % 3]).second) return {};
      }
    }
    Loop loop;
    int corner = next.begin()->first;
    do {
      loop.push_back(corner);
      corner = next[corner];
    } while (corner != loop.front() && loop.size() <= next.size());
    return loop.size() == next.size() ? loop : Loop{};
  }

  /// A corner of two faces only lies on an edge between them.
  void drop_corners_on_edges() {
    std::map<int, int> num_faces;
    for (const Loop& loop : loops_) {
      for (const int corner : loop) ++num_faces[corner];
    }
    for (Loop& loop : loops_) std::erase_if(loop, [&](int corner) { return num_faces[corner] < 3; });
  }

  const std::vector<Triangle>& triangles_;
  std::span<const core::Vec3> points_;
  double tolerance_;
  std::vector<int> face_;  ///< [triangles]
  std::vector<Loop> loops_;
};

/// The vector area of a polygon about its first corner (M. E. Newell).
core::Vec3 area_of(const model::Hull& hull, const model::Hull::Face& face) {
  const auto corner = [&](int i) -> const core::Vec3& {
    return hull.vertices[static_cast<std::size_t>(hull.corners[static_cast<std::size_t>(face.first + i)])];
  };
  core::Vec3 area = core::Vec3::Zero();
  for (int i = 1; i + 1 < face.count; ++i) area += (corner(i) - corner(0)).cross(corner(i + 1) - corner(0));
  return area;
}

void set_planes(model::Hull& hull) {
  for (model::Hull::Face& face : hull.faces) {
    face.normal = area_of(hull, face).normalized();
    face.height = -model::infinity;
    for (const core::Vec3& vertex : hull.vertices)
      face.height = std::max(face.height, face.normal.dot(vertex));
  }
}

/// False if some faces do not meet at their edges.
bool set_edges(model::Hull& hull) {
  bool is_closed = true;
  std::map<std::pair<int, int>, int> face_of;
  const auto for_each_side = [&](const auto& found) {
    for (int f = 0; f < static_cast<int>(hull.faces.size()); ++f) {
      const model::Hull::Face& face = hull.faces[static_cast<std::size_t>(f)];
      for (int i = 0; i < face.count; ++i)
        found(hull.corners[static_cast<std::size_t>(face.first + i)],
              hull.corners[static_cast<std::size_t>(face.first + (i + 1) % face.count)], f);
    }
  };
  for_each_side([&](int from, int to, int f) {
    is_closed = face_of.emplace(std::pair(from, to), f).second && is_closed;
  });
  for_each_side([&](int from, int to, int f) {
    const auto beyond = face_of.find({to, from});
    is_closed = is_closed && beyond != face_of.end();
    if (is_closed && from < to) hull.edges.push_back({{from, to}, {f, beyond->second}});
  });
  return is_closed;
}

/// False if faces were joined so that they do not meet at their edges.
bool join(const TriangleHull& triangles, std::span<const core::Vec3> points, double tolerance,
          model::Hull& hull) {
  std::map<int, int> vertex_of;  // by point
  for (const Loop& loop : FaceFinder(triangles, points, tolerance).find()) {
    if (loop.size() < 3) return false;
    hull.faces.push_back(
        {core::Vec3::UnitZ(), 0, static_cast<int>(hull.corners.size()), static_cast<int>(loop.size())});
    for (const int point : loop) {
      const auto [found, is_new] = vertex_of.emplace(point, static_cast<int>(hull.vertices.size()));
      if (is_new) hull.vertices.push_back(points[static_cast<std::size_t>(point)]);
      hull.corners.push_back(found->second);
    }
  }
  set_planes(hull);
  return set_edges(hull);
}

}  // namespace

model::Hull hull_of(const TriangleHull& triangles, std::span<const core::Vec3> points, double tolerance) {
  model::Hull hull;
  if (join(triangles, points, tolerance, hull)) return hull;
  constexpr double never = -1;
  model::Hull of_triangles;
  core::require_invariant(join(triangles, points, never, of_triangles), "a hull that is closed");
  return of_triangles;
}

}  // namespace pbmpi::geometry
