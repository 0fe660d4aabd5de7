/// A study of prediction as text, JSON and Markdown.
#pragma once

#include <string>

#include "app/pbreport/prediction/prediction_data.h"

namespace pbmpi::app {

/// "blown up in step 11", "not ended", or empty.
std::string fate_text(const PredictionRun& run);

std::string prediction_to_text(const PredictionStudy& study);
std::string prediction_to_json(const PredictionStudy& study);
std::string prediction_to_markdown(const PredictionStudy& study);

}  // namespace pbmpi::app
