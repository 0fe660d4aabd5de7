/// Mass properties of rigid bodies of one or several parts, of uniform density.
#pragma once

#include <array>
#include <vector>

#include "geometry/measures.h"
#include "model/model.h"

namespace pbmpi::scenes {

using geometry::solid_inertia;
using geometry::volume;

/// May a body have this inertia? None has a moment above the sum of the other two, except by the rounding of
/// three digits, as model files often give them for flat bodies, where the two are equal.
bool is_of_a_body(const model::Mat3& inertia);

/// A part of a rigid body, in a frame that all its parts share; `size` as in model::Geom.
struct Solid {
  model::Shape shape = model::Shape::box;
  std::array<double, 3> size{};
  core::Pose pose;
  std::shared_ptr<const model::Hull> hull = nullptr;  ///< with Shape::hull
};

double volume(const Solid& solid);  ///< [m^3]

/// The sum of the parts' volumes [m^3]: where two parts overlap, the overlap counts twice.
double volume(const std::vector<Solid>& solids);

struct MassProperties {
  double mass_kg = 0;
  model::Vec3 centre = model::Vec3::Zero();       ///< of mass [m], in the parts' frame
  model::Mat3 inertia = model::Mat3::Identity();  ///< [kg m^2] about the centre, axes of the parts' frame
};

/// What a mass at the end of `arm` [m] adds to a moment of inertia about the arm's start (Steiner).
model::Mat3 steiner(double mass_kg, const model::Vec3& arm);

/// The properties of parts of one density with a total mass of `mass_kg`.
MassProperties mass_properties(const std::vector<Solid>& solids, double mass_kg);

}  // namespace pbmpi::scenes
