/// The command line of "pbreport effects".
#pragma once

#include <string>
#include <vector>

#include "app/pbreport/study/report_options.h"

namespace pbmpi::app {

/// Throws core::InputError with one clear message.
ReportOfStudyOptions parse_effects_report_options(const std::vector<std::string>& args);

std::string effects_report_help_text();

}  // namespace pbmpi::app
