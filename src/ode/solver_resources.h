/// Resources of ODE's solver that are not part of a world.
#pragma once

#include "ode/objects/handles.h"

namespace pbmpi::ode {

/// Shared by the worlds of a stepper, which are stepped one after the other: a single working memory stays
/// warm in the cache, and the job list is separate from other steppers' (by default ODE has one list per
/// process).
class SolverResources {
 public:
  SolverResources();

  /// Makes an empty world that uses these resources and must not outlive them.
  WorldHandle make_world() const;

  /// To be called after an error was thrown out of a step: ODE can then neither reuse nor free its job list
  /// (it would abort), so its 100 bytes are leaked.
  void abandon() { static_cast<void>(jobs_.release()); }

 private:
  struct FreeJobs {
    void operator()(dThreadingImplementationID id) const { dThreadingFreeImplementation(id); }
  };
  std::unique_ptr<dxThreadingImplementation, FreeJobs> jobs_;
  WorldHandle memory_;  ///< empty; owns the working memory
};

}  // namespace pbmpi::ode
