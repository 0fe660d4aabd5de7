/// The step options that a study varies: lists of values on its command line, crossed with each other.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <boost/program_options.hpp>

#include "stepping/step_options.h"

namespace pbmpi::app {

/// How a study's command line describes a step option.
struct VariedOption {
  std::string_view name;
  std::string_view meaning;   ///< for --help
  std::string_view fallback;  ///< its values unless given, separated by blanks
};

/// The values of one step option.
struct SettingList {
  const stepping::StepOption* option;
  std::vector<std::string> values;
};

/// Adds an option that takes a list.
void add_setting_list(const VariedOption& varied, boost::program_options::options_description& description);

/// The values given, or the fallback. Throws core::InputError for an impossible one, and for one that stands
/// there twice, in whatever unit.
SettingList setting_list(const VariedOption& varied, const boost::program_options::variables_map& values);
std::vector<SettingList> setting_lists(std::span<const VariedOption> varied,
                                       const boost::program_options::variables_map& values);

/// The default_settings() of the stepper of `settings` with this law, but with their step's length and seed.
stepping::StepperSettings usual_settings(const stepping::StepperSettings& settings, stepping::Law law);

/// Takes each combination over `base`, the last list varying fastest. A stepper or a law brings its
/// usual_settings(). An option that a setting has no use for (one that its stepper lacks, iterations without
/// sweeps, a tolerance without a second substep or a memory, an approach without a memory) takes one value
/// only; sor with its soft law keeps its own number of iterations.
void cross_settings(const stepping::StepperSettings& base, std::span<const SettingList> lists,
                    const std::function<void(const stepping::StepperSettings&)>& take);

}  // namespace pbmpi::app
