/// The results of a study of prediction, scene by scene.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "analysis/error_bands.h"
#include "app/pbreport/study/instruction_mix.h"
#include "io/table/table_file.h"

namespace pbmpi::app {

/// Frequency of the paper's processor (Table 3).
inline constexpr double processor_hz = 3e9;

/// Over the measured frames.
struct HitCounts {
  double executed = 0, exact = 0, fuzzy = 0, wrong = 0;
  double error_sum = 0, error_max = 0;

  double coverage() const { return (exact + fuzzy) / executed; }  ///< correct predictions / executions
  double hit_rate() const { return (exact + fuzzy) / (exact + fuzzy + wrong); }  ///< correct / used
  double mean_error() const { return error_sum / fuzzy; }  ///< of values that enter the simulation
};

/// Frames on the modelled processor; NaN where none was modelled.
struct FrameRate {
  double hz = NAN;         ///< harmonic mean
  double satisfied = NAN;  ///< share of the frames within the budget
};

/// One case of the study.
struct PredictionRun {
  std::string name, stepper, precision, scope;
  double threshold = 0;
  bool feec = false, ended = false, same_hash = false, errors_known = false;
  int exit_code = 0;                  ///< -1: the time limit
  int frames_done = 0, measured = 0;  ///< measured: number of frames that count
  int nonfinite_step = -1, nonfinite_frame = -1;
  double islands = NAN, base_islands = NAN;
  double instructions = NAN;     ///< per frame, mean
  double collision_share = NAN;  ///< of the instructions
  InstructionMix mix{};
  HitCounts loads, operations;  ///< floating point
  FrameRate unpredicted, predicted;
  double defect_rms = 0, drift_rms = 0, floor_rms = 0;  ///< of positions [m]
  analysis::BandCounts defect_bands{}, drift_bands{}, floor_bands{};

  bool has_crashed() const { return !ended && exit_code > 0; }
  bool is_broken() const { return nonfinite_frame >= 0 || has_crashed(); }
  HitCounts all() const;
};

struct PredictionScene {
  std::string name;
  int worlds = 1, warmup = 0, frames = 0;
  std::vector<PredictionRun> runs;

  const PredictionRun& base() const { return runs.front(); }
  const PredictionRun* find(const std::string& run) const;
};

/// One bar of Figure 8.
struct Bar {
  std::string name;
  FrameRate rate;
  const PredictionRun* run = nullptr;  ///< null: the study has no such case
};

/// Another processor.
struct Sensitivity {
  std::string scene, run, variant;
  double cycles = 0, predicted_cycles = 0;
};

struct PredictionStudy {
  double budget_s = 0;
  std::string fvp;  ///< "FVP6": the threshold of Figure 8
  std::vector<PredictionScene> scenes;
  std::vector<Sensitivity> sensitivity;
};

/// `names`: these scenes only; empty: all. Throws core::InputError.
PredictionStudy prediction_study(const io::TableFile& file, const std::vector<std::string>& names);

/// Predictions of one engine in a scene, exact and fuzzy.
struct EngineHits {
  std::string engine;  ///< "quick single" (as in the paper), "quick double", "sor"
  HitCounts exact, fuzzy;
  int frames = 0;  ///< measured, in the fuzzy run: fewer where it was lost
};
/// The engines that the study has.
std::vector<EngineHits> engine_hits(const PredictionScene& scene, const std::string& fvp);

/// 20Iter, 19Iter, FEEC, FVP6, EVP, FEEC+FVP6.
std::vector<Bar> figure_8(const PredictionScene& scene, const std::string& fvp);

}  // namespace pbmpi::app
