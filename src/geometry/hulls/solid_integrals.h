/// Volume, centre of mass and inertia of what a closed surface of triangles encloses.
#pragma once

#include "core/vector.h"

namespace pbmpi::geometry {

/// Sums up the tetrahedra between the origin and each triangle, whose integrals of 1, x and x x^T are
/// polynomials of its corners (D. Eberly, "Polyhedral Mass Properties (Revisited)", 2002; B. Mirtich, "Fast
/// and Accurate Computation of Polyhedral Mass Properties", J. Graphics Tools 1, 1996). Exact for a closed
/// surface, wherever the origin is.
class SolidIntegrals {
 public:
  /// Adds a triangle [m], counter-clockwise as seen from outside.
  void add(const core::Vec3& a, const core::Vec3& b, const core::Vec3& c);

  double volume() const { return volume_; }    ///< [m^3] negative if the surface is inside out
  double surface() const { return surface_; }  ///< [m^2]
  core::Vec3 centre() const { return first_ / volume_; }
  /// [m^5] About the origin, for a density of 1 kg/m^3.
  core::Mat3 inertia() const { return second_.trace() * core::Mat3::Identity() - second_; }
  /// [m^5] The same about the centre of mass.
  core::Mat3 inertia_about_centre() const;

 private:
  double volume_ = 0, surface_ = 0;
  core::Vec3 first_ = core::Vec3::Zero();
  core::Mat3 second_ = core::Mat3::Zero();
};

}  // namespace pbmpi::geometry
