/// The command line of "pbreport prediction".
#pragma once

#include <string>
#include <vector>

#include "app/pbreport/study/report_options.h"

namespace pbmpi::app {

std::string prediction_report_help_text();
/// Throws core::InputError.
ReportOfStudyOptions parse_prediction_report_options(const std::vector<std::string>& args);

}  // namespace pbmpi::app
