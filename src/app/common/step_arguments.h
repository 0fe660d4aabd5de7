/// The options of a step on a command line.
#pragma once

#include <boost/program_options.hpp>

#include "stepping/step_choices.h"

namespace pbmpi::app {

/// Adds the option, as its row of stepping::step_options() describes it.
void add_step_option(const stepping::StepOption& option,
                     boost::program_options::options_description& description);

/// What a command line (with its files) says of the step. Throws core::InputError for a value that cannot be.
stepping::StepChoices step_arguments(const boost::program_options::variables_map& values);

}  // namespace pbmpi::app
