/// The command line of "pbreport study".
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/manual/manual.h"
#include "app/pbreport/study/report_options.h"

namespace pbmpi::app {

/// The statistic of the defect by which settings are ranked.
enum class ErrorMeasure { rms, p99, max, joint };

struct AccuracyReportOptions : ReportOfStudyOptions {
  ErrorMeasure measure = ErrorMeasure::rms;
  std::optional<double> budget_s;     ///< per frame
  std::optional<double> tolerance_m;  ///< of the error
  std::optional<std::string> config;
};

/// Throws core::InputError with one clear message.
AccuracyReportOptions parse_study_options(const std::vector<std::string>& args);

Manual study_manual();

}  // namespace pbmpi::app
