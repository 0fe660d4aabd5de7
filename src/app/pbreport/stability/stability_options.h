/// The command line of "pbreport stability".
#pragma once

#include <string>
#include <vector>

#include "app/pbreport/study/report_options.h"

namespace pbmpi::app {

/// Throws core::InputError with one clear message.
ReportOfStudyOptions parse_stability_report_options(const std::vector<std::string>& args);

std::string stability_report_help_text();

}  // namespace pbmpi::app
