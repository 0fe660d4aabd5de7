/// The axis of least overlap of a polyhedron and another solid.
#pragma once

#include <vector>

#include "geometry/hulls/least_overlap.h"
#include "geometry/hulls/polyhedron.h"

namespace pbmpi::geometry {

/// The line in the middle of a capsule or a cylinder, about the pair's origin.
struct Core {
  core::Vec3 centre = core::Vec3::Zero();
  core::Vec3 axis = core::Vec3::UnitZ();  ///< unit
  double half = 0;                        ///< [m] half its length
  double radius = 0;                      ///< [m]
};

/// Tries all axes that can separate a polyhedron and another convex solid: normals of faces, and normals of
/// an edge of each (S. Gottschalk, M. C. Lin, D. Manocha, "OBBTree", SIGGRAPH 1996), of which those count
/// whose arcs between the normals of their faces cross on the Gauss sphere (D. Gregorius, "The Separating
/// Axis Test between Convex Polyhedra", Game Developers Conference 2013). Keeps its memory.
class HullAxes {
 public:
  void separate(const Polyhedron& a, const Polyhedron& b, LeastOverlap& least);
  /// a: a capsule.
  void separate_capsule(const Core& a, const Polyhedron& b, LeastOverlap& least);
  /// a: a cylinder. Axes between its rims and edges are tried in steps of a sixteenth of a turn.
  void separate_cylinder(const Core& a, const Polyhedron& b, LeastOverlap& least);

 private:
  /// Of a face: the nearest vertex of the other solid, or, where that is not where they touch, its centre.
  struct Nearest {
    core::Vec3 point;
    double gap = 0;  ///< [m] of this point
  };
  static void try_faces(const Polyhedron& one, const Polyhedron& other, LeastOverlap::Kind kind,
                        std::vector<Nearest>& nearest, LeastOverlap& least);
  /// An edge that may be where the two touch.
  struct OpenEdge {
    int edge = 0;
    core::Vec3 from, along, first_normal, second_normal;
  };
  static void find_open_edges(const Polyhedron& one, const std::vector<Nearest>& nearest, double gap,
                              std::vector<OpenEdge>& open);

  std::vector<Nearest> nearest_a_, nearest_b_;
  std::vector<OpenEdge> open_a_, open_b_;
};

}  // namespace pbmpi::geometry
