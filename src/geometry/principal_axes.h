/// The principal axes of a body's inertia.
#pragma once

#include "model/model.h"

namespace pbmpi::geometry {

struct PrincipalAxes {
  model::Quat to_body;  ///< from the principal axes to the body's frame
  model::Vec3 moments;  ///< [kg m^2] of the first two axes those that differ least (as ratios)
};

/// `inertia` [kg m^2]: symmetric, positive definite.
PrincipalAxes principal_axes(const model::Mat3& inertia);

}  // namespace pbmpi::geometry
