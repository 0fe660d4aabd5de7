/// Volumes and moments of inertia of solid bodies of uniform density.
#pragma once

#include <array>
#include <vector>

#include "model/model.h"

namespace pbmpi::scenes {

/// Volume [m^3] of a solid shape; `size` as in model::Geom. Not for planes.
double volume(model::Shape shape, const std::array<double, 3>& size);

/// Inertia [kg m^2] about the centre of mass, in the shape's own axes (capsule and cylinder lie along z).
model::Mat3 solid_inertia(model::Shape shape, const std::array<double, 3>& size, double mass_kg);

/// May a body have this inertia? None has a moment above the sum of the other two, except by the rounding of
/// three digits, as model files often give them for flat bodies, where the two are equal.
bool is_of_a_body(const model::Mat3& inertia);

/// A part of a rigid body, in a frame that all its parts share; `size` as in model::Geom.
struct Solid {
  model::Shape shape = model::Shape::box;
  std::array<double, 3> size{};
  core::Pose pose;
};

/// The sum of the parts' volumes [m^3]: where two parts overlap, the overlap counts twice.
double volume(const std::vector<Solid>& solids);

struct MassProperties {
  double mass_kg = 0;
  model::Vec3 centre = model::Vec3::Zero();       ///< of mass [m], in the parts' frame
  model::Mat3 inertia = model::Mat3::Identity();  ///< [kg m^2] about the centre, axes of the parts' frame
};

/// The properties of parts of one density with a total mass of `mass_kg`.
MassProperties mass_properties(const std::vector<Solid>& solids, double mass_kg);

}  // namespace pbmpi::scenes
