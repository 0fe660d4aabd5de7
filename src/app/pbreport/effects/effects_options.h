/// The command line of "pbreport effects".
#pragma once

#include <string>
#include <vector>

#include "app/pbreport/study/report_options.h"

namespace pbmpi::app {

struct EffectsReportOptions : ReportOfStudyOptions {
  bool markdown = false;
};

/// Throws core::InputError with one clear message.
EffectsReportOptions parse_effects_report_options(const std::vector<std::string>& args);

std::string effects_report_help_text();

}  // namespace pbmpi::app
