/// How far two convex solids overlap, found by search: an oracle that shares nothing with the kernels.
#pragma once

#include "model/model.h"

namespace pbmpi::solver {

/// A geom in the world frame.
struct PlacedGeom {
  model::Geom geom;
  model::Vec3 centre;
  model::Mat3 rotation;
};

/// Distance from the centre to the farthest point along the unit vector n [m].
double support(const PlacedGeom& solid, const model::Vec3& n);

/// Overlap of two solids along n, which points into a [m]: below 0 there is a gap.
double overlap_along(const PlacedGeom& a, const PlacedGeom& b, const model::Vec3& n);

/// The least overlap over all directions, to some 1e-6 m: pattern search downhill from the lowest of many
/// directions. Below 0: how far they are apart. Where the overlap has a kink the search ends early, and its
/// result is too large.
double least_overlap(const PlacedGeom& a, const PlacedGeom& b);

/// Distance of a point from the solid [m], 0 inside.
double distance_outside(const PlacedGeom& solid, const model::Vec3& place);

}  // namespace pbmpi::solver
