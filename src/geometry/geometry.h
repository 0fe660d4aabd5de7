/// Rotations and extents of geoms, in double.
#pragma once

#include <array>

#include "model/contact.h"
#include "model/model.h"

namespace pbmpi::geometry {

/// Rotation matrix, by rows, of the quaternion (w, x, y, z) as given (not normalised; ODE's dQtoR).
void to_rotation(double w, double x, double y, double z, double rotation[9]);

/// A pose with the rotation matrix of its quaternion as given.
model::BodyPose body_pose(const core::Pose& pose);

/// The pose of the world frame, for static geoms.
model::BodyPose static_pose();

/// The geom's pose in the world, from its body's pose.
model::BodyPose geom_pose(const model::Geom& geom, const model::BodyPose& body);

/// What a solid geom consists of: the points within a radius of a box about its centre, in its own frame [m].
/// A hull and a mesh only lie within their boxes.
struct Extent {
  std::array<double, 3> half{};  ///< half sides of the box; a side may be 0
  double ball = 0;               ///< sphere, capsule: the radius in all directions
  double disc = 0;               ///< cylinder: the radius across z
};

/// All zero for a plane.
Extent extent_of(const model::Geom& geom);

/// Half sides [m] of the smallest world-aligned box about the geom's centre that holds it. Not for planes.
std::array<double, 3> half_extents(const model::Geom& geom, const double rotation[9]);

/// How far a geom reaches from its centre [m] along the unit `direction`; `rotation`: of the geom, by rows.
/// Infinite for a plane.
double half_extent(const model::Geom& geom, const double rotation[9], const core::Vec3& direction);

/// The least of a geom's reaches from its centre [m] over all directions; infinite for a plane, 0 for a mesh.
double least_half_extent(const model::Geom& geom);

/// Is the geom a sphere about its body's centre of mass? It needs no orientation, and a normal force does not
/// turn it.
bool is_ball(const model::Geom& geom);

/// Radius [m] of the smallest ball about the geom's centre that holds it; infinite for a plane.
double bounding_radius(const model::Geom& geom);

}  // namespace pbmpi::geometry
