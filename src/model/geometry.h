/// Rotations and extents of geoms, in double.
#pragma once

#include <array>

#include "model/contact.h"
#include "model/model.h"

namespace pbmpi::model {

/// Rotation matrix, by rows, of the quaternion (w, x, y, z) as it stands (not normalised; ODE's dQtoR).
void to_rotation(double w, double x, double y, double z, double rotation[9]);

/// The pose of the world frame, for static geoms.
BodyPose static_pose();

/// The geom's pose in the world, from its body's.
BodyPose geom_pose(const Geom& geom, const BodyPose& body);

/// Half sides [m] of the smallest world-aligned box about the geom's centre that holds it.
std::array<double, 3> half_extents(const Geom& geom, const double rotation[9]);

/// Is it a sphere round its body's centre of mass? Such a one has no orientation, and no normal turns it.
bool is_ball(const Geom& geom);

/// Radius [m] of the smallest ball about the geom's centre that holds it; infinite for a plane.
double bounding_radius(const Geom& geom);

}  // namespace pbmpi::model
