/// The points at which two solids touch, as hulls find them.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "core/vector.h"
#include "geometry/hulls/hull_axes.h"

namespace pbmpi::geometry {

struct ContactPoint {
  core::Vec3 position = core::Vec3::Zero();  ///< [m] half way between the surfaces, about the pair's origin
  double depth = 0;                          ///< [m]
};

/// At most four points with one normal.
struct ContactPoints {
  static constexpr int most = 4;
  core::Vec3 normal = core::Vec3::UnitZ();  ///< unit, into a
  std::array<ContactPoint, most> points;
  int count = 0;

  void add(const core::Vec3& position, double depth) {
    points[static_cast<std::size_t>(count++)] = {position, depth};
  }
};

/// Up to four of many points.
struct Chosen {
  std::array<std::size_t, ContactPoints::most> index{};
  int count = 0;

  void add(std::size_t i) { index[static_cast<std::size_t>(count++)] = i; }
};

/// Which of the points spread most: `first`, the one farthest from it, and the farthest on either side of the
/// line between these two, as for boxes (solver/collide/spread.h).
Chosen spread(std::span<const ContactPoint> points, std::size_t first, const core::Vec3& normal);

/// Cuts one solid's outline to the faces of another. Keeps its memory.
class ContactFinder {
 public:
  /// `margin` [m]: how far points may be apart.
  explicit ContactFinder(double margin_m) : margin_(margin_m) {}

  /// Two polyhedra that touch along an axis.
  void meet(const Polyhedron& a, const Polyhedron& b, const LeastOverlap& least, ContactPoints& found);
  /// a: the vertices of a polyhedron, b: a plane through `on_plane`.
  void lie_on_plane(const Polyhedron& a, const core::Vec3& on_plane, const core::Vec3& normal,
                    ContactPoints& found);
  /// a: a capsule that touches b along `normal`, with the depth of its nearest point.
  void meet_capsule(const Core& a, const Polyhedron& b, const core::Vec3& normal, double depth,
                    ContactPoints& found);
  void meet_cylinder(const Core& a, const Polyhedron& b, const LeastOverlap& least, ContactPoints& found);

  /// What of `a` is over a face of b, with the face's normal.
  void lie_on_face(const Polyhedron& a, const Polyhedron& b, int face, ContactPoints& found);
  void lie_capsule_on_face(const Core& a, const Polyhedron& b, int face, ContactPoints& found);
  void lie_cylinder_on_face(const Core& a, const Polyhedron& b, int face, double most_depth,
                            ContactPoints& found);

 private:
  /// Keeps the part of the outline that lies within a face's sides.
  void cut_to_face(const Polyhedron& one, int face);
  /// Keeps the part where side . x <= limit (Sutherland and Hodgman).
  void cut(const core::Vec3& side, double limit);
  void outline_face(const Polyhedron& one, int face);
  void lie_along_face(const Core& a, const Polyhedron& b, int face, const core::Vec3& normal,
                      ContactPoints& found);
  bool outline_cylinder(const Core& core, const core::Vec3& towards);
  /// Chooses points of the outline by their depths below a plane, at most `most_depth`.
  void choose(const core::Vec3& plane_normal, double height, double most_depth, ContactPoints& found);
  void add_between(const core::Vec3& on_a, const core::Vec3& on_b, double depth, ContactPoints& found) const {
    if (depth >= -margin_) found.add(0.5 * (on_a + on_b), depth);
  }

  double margin_;
  std::vector<core::Vec3> outline_, cut_outline_;
  std::vector<ContactPoint> deep_;
};

/// The points at which two segments are nearest to each other.
struct NearestPoints {
  core::Vec3 first = core::Vec3::Zero(), second = core::Vec3::Zero();
};
NearestPoints nearest_of_segments(const core::Vec3& from, const core::Vec3& way, const core::Vec3& other_from,
                                  const core::Vec3& other_way);

}  // namespace pbmpi::geometry
