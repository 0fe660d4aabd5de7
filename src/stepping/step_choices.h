/// What a user chooses about the step, option by option, and what the scene and the run fill in.
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <string_view>

#include "stepping/step_options.h"

namespace pbmpi::stepping {

/// What a command line or a program chooses about the step; options that it leaves open are as in
/// default_settings().
struct StepChoices {
  StepperSettings settings;
  std::set<std::string, std::less<>> given;  ///< names of the options that it sets, including shown defaults

  bool has(std::string_view option) const { return given.contains(option); }
};

/// Reads values by the names of their options. `dashes` precedes the names in messages: "--" on command
/// lines. Throws core::InputError for a name that no option has, suggesting the nearest, and for an invalid
/// value.
StepChoices choose_step(const std::map<std::string, std::string>& texts, const std::string& dashes);

/// What a scene and a run propose for options left open.
struct StepProposal {
  double dt_s = 0.01;
  int iterations = 20;
  std::uint64_t seed = 1;
};

/// The settings with which a run steps. Throws core::InputError, with `dashes` as above, if an option that
/// the stepper lacks does not have its default value.
StepperSettings settle_step(const StepChoices& choices, const StepProposal& proposal,
                            const std::string& dashes);

}  // namespace pbmpi::stepping
