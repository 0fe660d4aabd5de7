#include "app/common/estimate_spec.h"

#include <algorithm>
#include <set>

#include "app/common/step_arguments.h"
#include "core/error.h"
#include "engines/stepper_factory.h"
#include "estimate/short_run.h"
#include "stepping/names.h"

namespace pbmpi::app {

using stepping::StepperSettings;

StepperSettings default_estimate(const StepperSettings& precise) {
  // Forces that a crash's last substep ended with act for a whole substep of the estimate: six times as long,
  // not for a whole step.
  constexpr int substeps_in_one = 6;
  StepperSettings estimate = precise;
  estimate.iterations = 1;
  for (int* substeps : {&estimate.substeps, &estimate.law.most_substeps})
    *substeps = std::max(1, *substeps / substeps_in_one);
  estimate.law.newton = false;  // it takes far longer than the sweeps
  estimate.residuals = false;
  estimate.contacts = false;
  estimate.profile = false;
  return estimate;
}

StepperSettings estimate_settings(const std::string& setting, const StepperSettings& precise) {
  const std::string where = "--feec='" + setting + "'";
  const SettingWords words = setting_words(setting);
  StepperSettings estimate = default_estimate(precise);
  set_stepper(words, where, estimate);
  if (!traits_of(estimate.kind).has_precision) estimate.precision = stepping::Precision::double_;
  core::require_input(words.flags.empty(), where +
                                               ": write it as STEPPER iterations=N precision=NAME, each "
                                               "of which may be left out");
  std::set<std::string> seen;
  for (const auto& [name, value] : words.options) {
    core::require_input(seen.insert(name).second, where + ": " + name + " stands there twice");
    core::require_input(name == "iterations" || name == "precision",
                        where + ": " + name +
                            ": an estimate has a stepper, iterations and a precision of its own; all else is "
                            "as in the precise run");
    set_by_name(name, value, where, estimate);
  }
  return estimate;
}

std::string estimate_text(const StepperSettings& estimate) {
  std::string text(name_of(estimate.kind));
  for (const std::string_view name : {"iterations", "precision"}) {
    const stepping::StepOption& option = stepping::step_option(name);
    if (acts(option, estimate.kind)) text += " " + std::string(name) + "=" + text_of(option, estimate);
  }
  return text;
}

std::unique_ptr<stepping::Estimator> make_estimator(const StepperSettings& settings) {
  return std::make_unique<estimate::ShortRun>(engines::make_stepper(settings, "estimate: "));
}

}  // namespace pbmpi::app
