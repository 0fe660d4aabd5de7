/// How two solids that touch, or nearly touch, lie to each other.
#pragma once

#include "geometry/solid.h"

namespace pbmpi::geometry {

/// Do the solid's and the other's own axes show that they are farther apart than the tolerance [m]? The other
/// may be a plane. False for some solids that only come close.
bool are_apart(const Solid& solid, const Solid& other, double tolerance);

/// Does the other solid reach farther than the tolerance in front of a face's plane? For a plane: does it
/// cover part of the face?
bool reaches_over(const Solid& solid, const Face& face, const Solid& other, double tolerance);

/// Do two solids have faces in one plane, to within the tolerance, that look the same way?
bool are_flush(const Solid& one, const Solid& other, double tolerance);

}  // namespace pbmpi::geometry
