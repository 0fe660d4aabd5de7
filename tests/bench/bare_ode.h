/// The baseline: the code that a user of ODE would write to step these worlds, and nothing else.
#pragma once

#include <memory>
#include <vector>

#include "model/model.h"
#include "model/state.h"
#include "ode/objects/geoms.h"

namespace pbmpi::bench {

using Models = std::vector<std::shared_ptr<const model::Model>>;

/// The same bodies, geoms, joints and materials in ODE as in the stepper under test, each world in the ODE
/// space that is measured as fastest, stepped by dSpaceCollide, contact joints made in its callback,
/// dWorldQuickStep and dJointGroupEmpty. It has no seeds, no order of contacts, no state readout, no counts,
/// no clocks, and no events.
class BareOde {
 public:
  BareOde(const Models& models, double dt_s, int iterations);
  ~BareOde();
  BareOde(const BareOde&) = delete;
  BareOde& operator=(const BareOde&) = delete;

  /// Steps one world after the other, each through all its steps.
  void advance(int num_steps);

  model::State state(int world) const;
  /// Contacts of the last step, over all worlds.
  int num_contacts() const;

 private:
  class World;
  double dt_s_;
  std::vector<std::unique_ptr<World>> worlds_;
};

}  // namespace pbmpi::bench
