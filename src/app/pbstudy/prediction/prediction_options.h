/// The command line of "pbstudy prediction".
#pragma once

#include <string>
#include <vector>

#include "app/manual/manual.h"
#include "app/pbstudy/study/study_options.h"
#include "stepping/frame.h"

namespace pbmpi::app {

struct PredictionOptions : StudyOptions {
  std::vector<double> thresholds;         ///< for fuzzy prediction, the first one from Figure 8
  std::string detail_scene;               ///< the scene for the sensitivity table and the scopes; "none"
  std::vector<std::string> tool_options;  ///< for pbvalue, after the study's own
  double budget_s = stepping::default_frame_budget_s;  ///< per frame
  double time_limit_s = 0;                             ///< per run
  bool full = false;  ///< every world of every scene, cycles of every threshold
};

Manual prediction_manual();
/// Throws core::InputError.
PredictionOptions parse_prediction_options(const std::vector<std::string>& args);

}  // namespace pbmpi::app
