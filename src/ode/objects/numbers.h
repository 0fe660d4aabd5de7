/// Converts between ODE's numbers, which a build may have in single precision (PBMPI_ODE_SINGLE), and
/// pbmpi's.
#pragma once

#include "model/model.h"
#include "ode/objects/handles.h"

namespace pbmpi::ode {

inline dReal real(double x) { return static_cast<dReal>(x); }
/// The first three of ODE's four numbers.
inline model::Vec3 vec3(const dReal* v) { return {v[0], v[1], v[2]}; }

}  // namespace pbmpi::ode
