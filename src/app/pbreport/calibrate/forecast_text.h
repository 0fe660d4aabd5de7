/// Forecasts in words.
#pragma once

#include <string>

#include "app/pbreport/calibrate/forecasts.h"

namespace pbmpi::app {

/// Costs, forecasts, walls and checks as tables of text or of Markdown.
std::string forecast_text(const Calibration& calibration, const ForecastQuestion& question, bool as_markdown);

}  // namespace pbmpi::app
