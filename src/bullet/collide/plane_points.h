/// Finds the contact points of a convex geom near a plane.
#pragma once

#include "bullet/objects/engine.h"

namespace pbmpi::bullet {

/// Adds to `found` the points at which a shape at `place` touches the half space below the plane through
/// `plane`'s origin with its z axis as normal: one for a sphere, both ends of a capsule, the corners of a
/// box, and four points of each rim of a cylinder. Bullet's own algorithm finds one point of a capsule or
/// cylinder per step and keeps those of earlier steps, which no state holds.
void find_plane_points(const btCollisionShape& shape, const btTransform& place, const btTransform& plane,
                       btManifoldResult& found);

/// For a capsule or cylinder that lies on a face of a box, as `found`'s normal shows, adds those of its
/// points in find_plane_points() that are over the face.
void find_face_points(const btCollisionObjectWrapper& a, const btCollisionObjectWrapper& b,
                      btManifoldResult& found);

}  // namespace pbmpi::bullet
