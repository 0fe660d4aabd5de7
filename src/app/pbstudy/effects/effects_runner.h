/// Runs one case of "pbstudy effects" on this rank.
#pragma once

#include <cmath>
#include <cstdint>
#include <type_traits>

#include "analysis/error_bands.h"
#include "app/pbstudy/effects/effects_cases.h"
#include "app/pbstudy/study/case_stepper.h"
#include "io/table/table_file.h"

namespace pbmpi::app {

/// Order statistics of a sample.
struct Spread {
  double median = NAN, p10 = NAN, p90 = NAN;
};

/// Measurements of a case. Sent between ranks as its bytes. NaN where nothing is measured (a refused effect).
struct EffectResult {
  int index = 0;  ///< index of the case
  // Times are processor times of one step of all worlds, since other processes on the core disturb these less
  // than elapsed time. In a floor's case "without" is the other seed.
  Spread time_with_s, time_without_s;
  Spread cost_s;                                      ///< with - without, frame by frame and repeat by repeat
  Spread share;                                       ///< cost / time of the step with the effect
  std::uint64_t hash_baseline = 0, hash_variant = 0;  ///< at the end of the measured window
  // The variant's errors against the baseline.
  analysis::ErrorTable defect;  ///< after one frame from the baseline's state, all measured frames
  analysis::ErrorTable drift;   ///< at the end of the measured window
};
static_assert(std::is_trivially_copyable_v<EffectResult>);

/// `baseline`: the unchanged scene, stepped with the case's stepper and the study's seed.
EffectResult run_effect_case(const EffectCase& one, const StudyScene& scene, const Reference& baseline,
                             const stepping::StepperSettings& baseline_stepper, int repeats);

}  // namespace pbmpi::app
