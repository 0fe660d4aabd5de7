/// Hulls as parts of bodies.
#pragma once

#include <span>
#include <string>

#include "geometry/hulls/convex_hull.h"
#include "scenes/parts/mass_properties.h"

namespace pbmpi::scenes {

/// The hull as a part, for points given in `frame`.
Solid solid_of(const geometry::FoundHull& found, const core::Pose& frame);

/// The hull of 128 points of an ellipsoid with these half axes [m].
geometry::FoundHull hull_of_ellipsoid(const core::Vec3& half, const std::string& where);

/// A sentence on what the hull leaves out of its points; empty if that is nothing. `before_m`: what had been
/// left out before.
std::string note_on(const geometry::FoundHull& found, double before_m);

}  // namespace pbmpi::scenes
