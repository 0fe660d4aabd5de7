/// One world in ODE, for tests of its motion.
#pragma once

#include <string>

#include "stepping/stepper.h"
#include "support/one_world.h"

namespace pbmpi::ode {

/// The sink of tests that expect no message: the test fails with the line.
void fail_on_warning(const std::string& line);

/// With `quick`, any message of ODE fails the test; with `direct`, any except that of its LCP solver.
class Simulation : public support::OneWorld {
 public:
  Simulation(const model::Model& model, const stepping::StepperSettings& settings);
};

/// The bits of a world after `num_steps` steps, alone in a new stepper.
std::uint64_t hash_after(const model::Model& model, const stepping::StepperSettings& settings, int world,
                         int num_steps);

}  // namespace pbmpi::ode
