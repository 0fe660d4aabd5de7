/// Where a convex geom is near a plane.
#pragma once

#include "bullet/objects/engine.h"

namespace pbmpi::bullet {

/// Adds to `found` the points in which a shape at `place` touches the half space below the plane through
/// `plane`'s origin with its z axis as normal: of a sphere one, of a capsule both ends, of a box its corners,
/// of a cylinder four points of each rim. Bullet's own algorithm finds one point of a capsule or cylinder a
/// step and keeps those of earlier steps, which no state holds.
void find_plane_points(const btCollisionShape& shape, const btTransform& place, const btTransform& plane,
                       btManifoldResult& found);

/// Of a capsule or cylinder that lies on a face of a box, which `found` tells by its normal, adds those of
/// the same points that are over the face.
void find_face_points(const btCollisionObjectWrapper& a, const btCollisionObjectWrapper& b,
                      btManifoldResult& found);

}  // namespace pbmpi::bullet
