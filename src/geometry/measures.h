/// What follows from the shapes and the sizes of solids alone.
#pragma once

#include <array>
#include <vector>

#include "model/model.h"

namespace pbmpi::geometry {

/// Volume [m^3] of a solid shape; `size` as in model::Geom. Not for planes, hulls and meshes.
double volume(model::Shape shape, const std::array<double, 3>& size);

/// Inertia [kg m^2] about the centre of mass, in the shape's own axes (capsule and cylinder lie along z). Not
/// for planes, hulls and meshes.
model::Mat3 solid_inertia(model::Shape shape, const std::array<double, 3>& size, double mass_kg);

/// Cd A [m^2] of a geom, as if it were its body's only geom and nothing stood near.
///
/// A is the mean area of a convex body's shadow over all directions: a quarter of its surface (Cauchy), since
/// a tumbling body shows all its sides. Cd at Re of 1e4 to 2e5: sphere 0.47 and cube 1.05 from S. F. Hoerner,
/// Fluid-Dynamic Drag (1965), chapter III; cylinder 0.82 (ten diameters long, side on) from C. Matthews,
/// Aeronautical Engineer's Data Book (2002), chapter 5. A capsule is taken as round as a sphere, a
/// hull as angular as a cube.
double drag_area(const model::Geom& geom);

/// [num_bodies] Diameter of the ball about its centre of mass that holds a body's geoms [m]; 0 for a body
/// without geoms.
std::vector<double> sizes_of(const model::Model& model);

}  // namespace pbmpi::geometry
