/// Runs one case of "pbstudy prediction": pbmpi under pbvalue, and compares it with the unpredicted run.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "analysis/error_table.h"
#include "app/pbstudy/prediction/prediction_cases.h"
#include "app/pbstudy/study/case_outcome.h"

namespace pbmpi::app {

/// In pbvalue's order and with its names.
inline constexpr std::array<const char*, 4> value_classes = {"fp_load", "fp_operation", "int_load",
                                                             "int_operation"};
inline constexpr std::array<const char*, 5> mix_classes = {"floating_point", "integer", "branch", "store",
                                                           "load"};

/// Executions and predictions of one class of values.
struct ClassHits {
  std::int64_t executed = 0, repeated = 0, exact = 0, fuzzy = 0, wrong = 0;
  double error_sum = 0, error_max = 0;
};

/// A frame, or its estimate. Plain data.
struct PredictedFrame {
  std::int32_t case_index = 0, frame = 0;
  std::int32_t is_estimate = 0;
  std::int64_t instructions = 0, collision_instructions = 0;
  std::array<std::int64_t, 5> mix{};
  std::array<ClassHits, 4> hits{};
  std::int64_t micro_ops = -1, cycles = -1, predicted_cycles = -1;  ///< -1: not modelled
};

/// Cycles of all modelled frames of a case, with another processor. Plain data.
struct VariantCycles {
  std::int32_t case_index = 0, variant = 0;
  std::int64_t cycles = 0, predicted_cycles = 0;
};

/// The outcome of a run. Plain data.
struct PredictionResult {
  std::int32_t index = 0;
  std::int32_t exit_code = 0;         ///< pbmpi's: 1 with a number that is not finite, above 128 by a signal
  std::int32_t ended = 0;             ///< 1: by itself, within the time limit
  std::int32_t num_frames = 0;        ///< counted frames, both warm-up and measured ones
  std::int32_t same_hash = 0;         ///< 1: the bits of the unpredicted run
  std::int32_t nonfinite_frame = -1;  ///< the first with a number that is not finite; -1: none
  std::int32_t nonfinite_step = -1;   ///< its step; -1: all numbers of the second run stayed finite
  std::int32_t errors_known = 0;      ///< 1: a frame could be compared
  double islands_mean = 0, islands_max = 0, base_islands_mean = 0;
  analysis::ErrorTable defect;  ///< after the first frame, from the same state
  analysis::ErrorTable drift;   ///< over the measured frames; with FEEC of the estimates
  analysis::ErrorTable floor;   ///< drift caused by another solver seed
};

using PredictionOutcome = CaseOutcome<PredictionResult, PredictedFrame, VariantCycles>;

class UnpredictedRuns;

/// Throws core::InputError where this build has no pbvalue.
void require_tool();

/// Throws core::RunError if a run ends abnormally. `case_index` goes into the rows; `unpredicted`, used for
/// all cases, holds the runs that they share.
PredictionOutcome run_prediction_case(const PredictionCase& one, const StudyScene& scene,
                                      const PredictionOptions& options, int case_index,
                                      UnpredictedRuns& unpredicted);

}  // namespace pbmpi::app
