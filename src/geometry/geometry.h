/// Rotations and extents of geoms, in double.
#pragma once

#include <array>

#include "model/contact.h"
#include "model/model.h"

namespace pbmpi::geometry {

/// Rotation matrix, by rows, of the quaternion (w, x, y, z) as it stands (not normalised; ODE's dQtoR).
void to_rotation(double w, double x, double y, double z, double rotation[9]);

/// The pose of the world frame, for static geoms.
model::BodyPose static_pose();

/// The geom's pose in the world, from its body's.
model::BodyPose geom_pose(const model::Geom& geom, const model::BodyPose& body);

/// Half sides [m] of the smallest world-aligned box about the geom's centre that holds it.
std::array<double, 3> half_extents(const model::Geom& geom, const double rotation[9]);

/// Is it a sphere round its body's centre of mass? Such a one has no orientation, and no normal turns it.
bool is_ball(const model::Geom& geom);

/// Radius [m] of the smallest ball about the geom's centre that holds it; infinite for a plane.
double bounding_radius(const model::Geom& geom);

}  // namespace pbmpi::geometry
