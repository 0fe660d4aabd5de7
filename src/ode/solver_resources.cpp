#include "ode/solver_resources.h"

namespace pbmpi::ode {

SolverResources::SolverResources()
    : jobs_(dThreadingAllocateSelfThreadedImplementation()), memory_(dWorldCreate()) {}

WorldHandle SolverResources::make_world() const {
  WorldHandle world(dWorldCreate());
  dWorldSetStepThreadingImplementation(world.get(), dThreadingImplementationGetFunctions(jobs_.get()),
                                       jobs_.get());
  dWorldUseSharedWorkingMemory(world.get(), memory_.get());
  return world;
}

}  // namespace pbmpi::ode
