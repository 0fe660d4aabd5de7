#include "app/common/estimate_spec.h"

#include <algorithm>

#include "engines/stepper_factory.h"
#include "estimate/short_run.h"

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
  estimate.residuals = false;
  estimate.contacts = false;
  return estimate;
}

std::unique_ptr<stepping::Estimator> make_estimator(const StepperSettings& settings) {
  return std::make_unique<estimate::ShortRun>(engines::make_stepper(settings, "estimate: "));
}

}  // namespace pbmpi::app
