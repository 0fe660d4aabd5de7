/// ODE's numbers, and move-only owners of its objects. A bare id (dBodyID, dGeomID, dJointID) is borrowed:
/// its world or space owns it.
#pragma once

#include <memory>
#include <type_traits>

#include <ode/ode.h>

#include "model/model.h"

namespace pbmpi::ode {

#ifdef dIDESINGLE  // ODE's own macro, set for the library pbmpi_ode_single and nowhere else
inline constexpr bool is_single_precision = true;
#else
inline constexpr bool is_single_precision = false;
#endif
static_assert(
    std::is_same_v<dReal, float> == is_single_precision,
    "ODE's headers have the wrong precision: double (Debian: libode-dev), or single in the folder of "
    "PBMPI_ODE_SINGLE");

inline dReal real(double x) { return static_cast<dReal>(x); }
/// The first three of ODE's four numbers.
inline model::Vec3 vec3(const dReal* v) { return {v[0], v[1], v[2]}; }

struct DestroyWorld {
  void operator()(dWorldID id) const { dWorldDestroy(id); }
};
struct DestroySpace {
  void operator()(dSpaceID id) const { dSpaceDestroy(id); }
};
struct DestroyJointGroup {
  void operator()(dJointGroupID id) const { dJointGroupDestroy(id); }
};

using WorldHandle = std::unique_ptr<dxWorld, DestroyWorld>;
using SpaceHandle = std::unique_ptr<dxSpace, DestroySpace>;
using JointGroupHandle = std::unique_ptr<dxJointGroup, DestroyJointGroup>;

}  // namespace pbmpi::ode
