/// A study of effects read back.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/error_table.h"
#include "io/table/table_file.h"
#include "stepping/stepper.h"

namespace pbmpi::app {

/// Median, 10th and 90th percentile of a sample.
struct ReadSpread {
  double median = 0, p10 = 0, p90 = 0;
};

/// A row of /cases. Numbers are NaN where nothing was measured.
struct EffectRow {
  std::string scene, kind, effect, reason, hash_baseline, hash_variant;
  stepping::StepperSettings stepper;
  bool called_for = false;
  std::optional<bool> same_bits;  ///< none: nothing was measured
  int worlds = 1;
  ReadSpread time_with_s, time_without_s, cost_s;  ///< for a step of all worlds
  ReadSpread share;                                ///< of the time of a step with the effect
  std::optional<double> instructions_with, instructions_without;
  analysis::ErrorTable defect, drift;

  bool measured() const { return same_bits.has_value(); }
  /// Share of the instructions of the step with the effect; none if nothing counted them.
  std::optional<double> instruction_share() const;
  /// The study adds the effect to the scene: nothing calls for it, it comes only on request, or the scene
  /// leaves it out.
  bool demanded() const { return kind == "demanded"; }
  /// The effect must not change the result. `called_for` cannot tell: an effect that comes only on request is
  /// not called for either.
  bool unneeded() const { return reason.starts_with("nothing calls for it"); }
};

/// The cases of one scene and one stepper.
struct EffectScene {
  std::string name;
  std::string stepper;  ///< "quick", "sor double"
  std::vector<EffectRow> effects;
  std::vector<EffectRow> floor;  ///< other solver seeds

  /// Largest rms of body positions that another seed alone caused [m].
  double floor_defect_m() const;
  double floor_drift_m() const;
  /// Largest share of a step that another seed alone seemed to cost: the clock does not resolve less.
  double floor_share() const;
  /// Median time of a step of the unchanged scene [s]; NaN if nothing was measured.
  double step_s() const;
};

/// In the order of the file. Throws core::InputError for a scene that is not in it.
std::vector<EffectScene> effect_scenes(const io::TableFile& file, const std::vector<std::string>& names);

/// How instructions were counted: none, perf_event, callgrind.
std::string instructions_by(const io::TableFile& file);

}  // namespace pbmpi::app
