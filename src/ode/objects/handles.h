/// Move-only owners of ODE's objects. A bare id (dBodyID, dGeomID, dJointID) is borrowed: its world or space
/// owns it.
#pragma once

#include <memory>
#include <type_traits>

#include <ode/ode.h>

namespace pbmpi::ode {

static_assert(std::is_same_v<dReal, double>, "pbmpi needs ODE in double precision (Debian: libode-dev)");

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
