/// Between ODE's numbers, of single precision in a build for it (PBMPI_ODE_SINGLE), and pbmpi's.
#pragma once

#include "model/model.h"
#include "ode/objects/handles.h"

namespace pbmpi::ode {

inline dReal real(double x) { return static_cast<dReal>(x); }
/// The first three of ODE's four numbers.
inline model::Vec3 vec3(const dReal* v) { return {v[0], v[1], v[2]}; }

}  // namespace pbmpi::ode
