/// The options of a step on a command line, and settings in words.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include <boost/program_options.hpp>

#include "stepping/step_choices.h"

namespace pbmpi::app {

/// Adds the option, as its row of stepping::step_options() describes it.
void add_step_option(const stepping::StepOption& option,
                     boost::program_options::options_description& description);

/// Step options given on a command line (with its files). Throws core::InputError for an impossible value.
stepping::StepChoices step_arguments(const boost::program_options::variables_map& values);

/// A setting in words: "sor law=ode iterations=80", "iterations=5".
struct SettingWords {
  std::string stepper;                                       ///< empty: none is named
  std::vector<std::pair<std::string, std::string>> options;  ///< names and values
  std::vector<std::string> flags;                            ///< further words without a value
};

/// The words of `text`. A law comes first among the options, as it brings its own iterations and substeps.
SettingWords setting_words(const std::string& text);

/// Sets the stepper that `words` names, if any. Throws core::InputError, opening with `where`, for one that
/// there is not, or that the build lacks.
void set_stepper(const SettingWords& words, const std::string& where, stepping::StepperSettings& settings);

/// Sets a step option by its name. Throws core::InputError, opening with `where`, for an option that the
/// stepper does not have, and for an impossible value.
void set_by_name(const std::string& name, const std::string& value, const std::string& where,
                 stepping::StepperSettings& settings);

}  // namespace pbmpi::app
