/// What somebody chooses of a step, option by option, and what the scene and the run fill in.
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <string_view>

#include "stepping/step_options.h"

namespace pbmpi::stepping {

/// What a command line or a program says of the step; what it leaves open is as in default_settings().
struct StepChoices {
  StepperSettings settings;
  std::set<std::string, std::less<>> given;  ///< names of the options that it sets, shown defaults among them

  bool has(std::string_view option) const { return given.contains(option); }
};

/// Reads values by the names of their options. `dashes` stands before the names in messages: "--" on command
/// lines. Throws core::InputError for a name that no option has, with the nearest, and for a value that
/// cannot be.
StepChoices choose_step(const std::map<std::string, std::string>& texts, const std::string& dashes);

/// What a scene and a run say where nobody has chosen.
struct StepProposal {
  double dt_s = 0.01;
  int iterations = 20;
  std::uint64_t seed = 1;
};

/// The settings with which a run steps. Throws core::InputError, with `dashes` as above, if an option that
/// the stepper lacks has another value than its default.
StepperSettings settle_step(const StepChoices& choices, const StepProposal& proposal,
                            const std::string& dashes);

}  // namespace pbmpi::stepping
