/// The options of a step on a command line.
#pragma once

#include <boost/program_options.hpp>

#include "stepping/step_choices.h"

namespace pbmpi::app {

/// Adds the option, as its row of stepping::step_options() describes it.
void add_step_option(const stepping::StepOption& option,
                     boost::program_options::options_description& description);

/// Step options given on a command line (with its files). Throws core::InputError for an impossible value.
stepping::StepChoices step_arguments(const boost::program_options::variables_map& values);

}  // namespace pbmpi::app
