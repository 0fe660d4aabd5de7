/// Runs a world in each of the steppers.
#pragma once

#include <memory>
#include <ostream>
#include <string>
#include <vector>

#include "stepping/stepper.h"

namespace pbmpi::scenes {

struct SteppedBy {
  std::string name;  ///< in a test's name
  stepping::StepperSettings settings;
};

/// Prints the name in a test's name.
inline std::ostream& operator<<(std::ostream& out, const SteppedBy& by) { return out << by.name; }

/// quick, direct, and sor: with ODE's law in double precision, in single precision and with substeps, and as
/// it is meant to be used.
std::vector<SteppedBy> every_stepper();

/// A stepper with these settings, of any kind, without worlds.
std::unique_ptr<stepping::WorldStepper> make_stepper(const stepping::StepperSettings& settings);

/// The state after `num_steps` steps of world 0 of the scene with this text.
model::State state_after(const std::string& toml, const stepping::StepperSettings& settings, int num_steps);

}  // namespace pbmpi::scenes
