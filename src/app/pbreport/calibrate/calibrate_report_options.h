/// The command line of "pbreport calibrate".
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/pbreport/calibrate/forecasts.h"
#include "app/pbreport/tables/print_options.h"

namespace pbmpi::app {

struct CalibrateReportOptions {
  bool help = false;
  PrintForm form = PrintForm::text;
  bool quiet = false;
  std::string file, table;  ///< table: the one for csv
  std::optional<std::string> csv;
  ForecastQuestion question;
};

/// Throws core::InputError with one clear message.
CalibrateReportOptions parse_calibrate_report_options(const std::vector<std::string>& args);

}  // namespace pbmpi::app
