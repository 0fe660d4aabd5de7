/// A basis of the plane across a unit vector, in lanes.
#pragma once

#include "solver/lanes/lanes.h"

namespace pbmpi::solver {

/// Two unit vectors perpendicular to the unit vector n and to each other (ODE's dPlaneSpace).
template <class T>
PBMPI_LANES void plane_space(const Vec3L<typename T::V>& n, Vec3L<typename T::V>& p,
                             Vec3L<typename T::V>& q) {
  using V = typename T::V;
  const auto steep = T::abs(n.z) > T::broadcast(static_cast<typename T::Scalar>(0.7071067811865475244));
  const V zero = T::broadcast(0);
  const V a = steep ? n.y * n.y + n.z * n.z : n.x * n.x + n.y * n.y;
  const V k = 1 / T::sqrt(a);
  p.x = steep ? zero : -n.y * k;
  p.y = steep ? -n.z * k : n.x * k;
  p.z = steep ? n.y * k : zero;
  q.x = steep ? a * k : -n.z * p.y;
  q.y = steep ? -n.x * p.z : n.z * p.x;
  q.z = steep ? n.x * p.y : a * k;
}

}  // namespace pbmpi::solver
