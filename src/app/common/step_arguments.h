/// The options of a step on a command line, and settings in words.
#pragma once

#include <array>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <boost/program_options.hpp>

#include "stepping/estimator.h"
#include "stepping/step_choices.h"
#include "stepping/stepper.h"

namespace pbmpi::app {

/// The settings of an estimate of `precise` unless it is given others: one sweep in each of a sixth of
/// its substeps.
stepping::StepperSettings default_estimate(const stepping::StepperSettings& precise);

/// The settings of an estimate of `precise` that `setting` names: nothing, or words such as "quick",
/// "iterations=5", "sor iterations=3 precision=single"; what it leaves open is as in default_estimate().
/// Throws core::InputError for any other.
stepping::StepperSettings estimate_settings(const std::string& setting,
                                            const stepping::StepperSettings& precise);

/// The step options that an estimate may have otherwise than the precise stepper.
inline constexpr std::array<std::string_view, 3> estimate_options = {"stepper", "iterations", "precision"};

/// As a setting that estimate_settings() reads: "sor iterations=1 precision=double".
std::string estimate_text(const stepping::StepperSettings& estimate);

/// An estimator that makes a short run of each frame.
std::unique_ptr<stepping::Estimator> make_estimator(const stepping::StepperSettings& settings);

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
