/// Reads the file that pbvalue writes (docs/prediction.md) into rows of the study.
#pragma once

#include <string>

#include "app/pbstudy/prediction/prediction_runner.h"

namespace pbmpi::app {

/// Adds frames and variants with case index `case_index`. False if the file holds no report.
bool read_tool_report(const std::string& path, const PredictionCase& one, int case_index,
                      PredictionOutcome& outcome);

}  // namespace pbmpi::app
