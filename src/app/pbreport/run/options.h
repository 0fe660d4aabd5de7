/// The command line of "pbreport [report] FILE".
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace pbmpi::app {

enum class ReportAction { report, help, version };

struct ReportOptions {
  ReportAction action = ReportAction::report;
  std::string file;                 ///< the run's HDF5 file
  std::optional<std::string> html;  ///< where to write the page
  std::optional<std::string> xdmf;  ///< where to write the sidecar
  bool json = false;                ///< the summary as JSON
  bool quiet = false;               ///< no text summary
};

/// Throws core::InputError with one clear message.
ReportOptions parse_report_options(const std::vector<std::string>& args);

/// What --help says of the options.
std::string report_options_text();

}  // namespace pbmpi::app
