/// The options of a step on a command line.
#pragma once

#include <functional>
#include <set>
#include <string>

#include <boost/program_options.hpp>

#include "stepping/step_options.h"

namespace pbmpi::app {

/// What a command line (with its files) says of the step; what it leaves open is as in
/// stepping::default_settings().
struct StepArguments {
  stepping::StepperSettings settings;
  std::set<std::string, std::less<>> given;  ///< names of the options that it sets, shown defaults among them

  bool has(std::string_view option) const { return given.contains(option); }
};

/// Adds the option, as its row of stepping::step_options() describes it.
void add_step_option(const stepping::StepOption& option,
                     boost::program_options::options_description& description);

/// Throws core::InputError for a value that cannot be.
StepArguments step_arguments(const boost::program_options::variables_map& values);

/// Throws core::InputError if an option that the stepper lacks has another value than its default.
void require_fitting(const stepping::StepperSettings& settings);

}  // namespace pbmpi::app
