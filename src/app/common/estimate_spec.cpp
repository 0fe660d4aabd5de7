#include "app/common/estimate_spec.h"

#include <algorithm>

#include "engines/stepper_factory.h"
#include "estimate/partly_precise.h"
#include "estimate/same_solve.h"
#include "estimate/short_run.h"
#include "estimate/until_due.h"
#include "stepping/stepper_traits.h"

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

EstimateSource source_of(const EstimateSpec& estimate, const StepperSettings& precise, int steps_per_frame) {
  if (estimate.due_s) return EstimateSource::until_due;
  const bool one_solve =
      traits_of(precise.kind).is_anytime && steps_per_frame - estimate.after == 1 && precise.substeps == 1;
  const bool passes = estimate.stepper.kind == precise.kind &&
                      estimate.stepper.precision == precise.precision &&
                      estimate.stepper.iterations <= precise.iterations;
  return one_solve && passes ? EstimateSource::same_solve : EstimateSource::short_run;
}

std::unique_ptr<stepping::Estimator> make_estimator(const EstimateSpec& estimate,
                                                    stepping::FrameStepper& precise) {
  std::unique_ptr<stepping::Estimator> estimator;
  if (estimate.source == EstimateSource::same_solve) {
    estimator = std::make_unique<pbmpi::estimate::SameSolve>(precise, estimate.stepper.iterations);
  } else {
    estimator =
        std::make_unique<pbmpi::estimate::ShortRun>(engines::make_stepper(estimate.stepper, "estimate: "));
  }
  if (estimate.due_s)
    return std::make_unique<pbmpi::estimate::UntilDue>(precise, std::move(estimator), *estimate.due_s,
                                                       estimate.stepper.dt_s);
  if (estimate.after > 0)
    return std::make_unique<pbmpi::estimate::PartlyPrecise>(precise, std::move(estimator), estimate.after);
  return estimator;
}

}  // namespace pbmpi::app
