/// The points at which a solid lies on a flat face of another.
#pragma once

#include <array>

#include "geometry/solid.h"

namespace pbmpi::geometry {

struct FacePoint {
  core::Vec3 position;  ///< half way between the two surfaces, in the solids' frame [m]
  double depth = 0;     ///< [m]; below 0: a gap
};

struct FacePoints {
  static constexpr int most = 4;
  std::array<FacePoint, most> points;
  int count = 0;
  const FacePoint* begin() const { return points.data(); }
  const FacePoint* end() const { return points.data() + count; }
};

/// The part of `solid` nearest to the plane of a face of `other`, cut off at the face's border (a disc's is
/// taken as the octagon about it): the deepest point, then those farthest from the points before it. Only
/// points of at least `least_depth` [m]. `solid` is no plane.
FacePoints lie_on_face(const Solid& solid, const Solid& other, const Face& face, double least_depth);

}  // namespace pbmpi::geometry
