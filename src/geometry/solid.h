/// Geoms as convex solids in a common frame: their faces, and which normals they allow at a point.
#pragma once

#include <array>
#include <optional>

#include "geometry/geometry.h"

namespace pbmpi::geometry {

/// A geom placed in a frame.
struct Solid {
  model::Shape shape = model::Shape::box;
  core::Vec3 centre = core::Vec3::Zero();    ///< of a plane: a point of it
  core::Mat3 axes = core::Mat3::Identity();  ///< its own axes as columns; z is a plane's normal
  Extent extent;
  const model::Hull* hull = nullptr;  ///< borrowed; with Shape::hull

  /// How far it reaches from its centre [m] along a unit vector; 0 for a plane.
  double half_along(const core::Vec3& direction) const;
};

/// `pose`: the geom's own (geom_pose()).
Solid solid_at(const model::Geom& geom, const model::BodyPose& pose);

/// A flat face of a box (all six) or a cylinder (the two ends, across z).
struct Face {
  int axis = 2;
  double sign = 1;  ///< which of the two across the axis
};

/// The faces of a solid; faces[i] is bit i of a set of faces.
struct Faces {
  std::array<Face, 6> faces;
  int count = 0;
  const Face* begin() const { return faces.data(); }
  const Face* end() const { return faces.data() + count; }
};
Faces faces_of(const Solid& solid);
/// The place of a box's or a cylinder's face in Faces.
int index_of(const Solid& solid, const Face& face);
/// Unit, out of the solid.
inline core::Vec3 normal_of(const Solid& solid, const Face& face) {
  return face.sign * solid.axes.col(face.axis);
}

/// Directions may differ by this [rad] and still count as equal. A contact that leans by as much turns 1e-5
/// of its force; kernels in single precision are right to 1e-6.
inline constexpr double least_lean = 1e-5;

/// The outward normals of a solid at one of its points: all sums, with weights that are not negative, of up
/// to three unit vectors perpendicular to each other. None: the point is inside.
struct NormalCone {
  std::array<core::Vec3, 3> edge;
  int count = 0;
  bool holds(const core::Vec3& normal) const;
};

/// The normals at a point; a face counts as there if it is within the tolerance [m] of the point. Nothing if
/// the point is farther outside than that. Not for hulls.
std::optional<NormalCone> normals_at(const Solid& solid, const core::Vec3& point, double tolerance);

/// Where a solid is touched along an outward normal.
struct Support {
  enum class Kind {
    face,   ///< on a flat face
    round,  ///< on a surface with one normal a point
    edge    ///< on an edge, a rim or a corner
  };
  Kind kind = Kind::face;
  core::Vec3 point;  ///< on the surface
  Face face;         ///< with Kind::face
};

/// The point of the surface at which `normal` (unit, out of the solid) is a normal, nearest to `near`. Not
/// for planes and hulls.
Support support_at(const Solid& solid, const core::Vec3& normal, const core::Vec3& near);

}  // namespace pbmpi::geometry
