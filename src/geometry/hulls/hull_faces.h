/// The flat faces and the edges of a hull of triangles.
#pragma once

#include "geometry/hulls/triangle_hull.h"
#include "model/model.h"

namespace pbmpi::geometry {

/// The polyhedron whose faces are the triangles, those in one plane to within `tolerance` [m] as one. All of
/// its vertices are on or below the planes of all faces. Its mass properties are not set.
model::Hull hull_of(const TriangleHull& triangles, std::span<const core::Vec3> points, double tolerance);

}  // namespace pbmpi::geometry
