/// What ODE's solver works with besides a world.
#pragma once

#include "ode/objects/handles.h"

namespace pbmpi::ode {

/// Shared by the worlds of a stepper, which are stepped one after the other: one working memory stays warm in
/// the cache, and one job list is apart from other steppers' (ODE's default is one list a process).
class SolverResources {
 public:
  SolverResources();

  /// An empty world that works with these. It must not outlive them.
  WorldHandle make_world() const;

  /// After an error was thrown out of a step, ODE can neither reuse nor free its job list (it would abort):
  /// these 100 bytes are given up.
  void abandon() { static_cast<void>(jobs_.release()); }

 private:
  struct FreeJobs {
    void operator()(dThreadingImplementationID id) const { dThreadingFreeImplementation(id); }
  };
  std::unique_ptr<dxThreadingImplementation, FreeJobs> jobs_;
  WorldHandle memory_;  ///< empty; owns the working memory
};

}  // namespace pbmpi::ode
