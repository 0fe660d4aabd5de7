/// "pbreport [report] FILE": the summary of one run, its page, its sidecar.
#pragma once

#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include <boost/program_options.hpp>

#include "core/error.h"

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

/// All options, in groups.
boost::program_options::options_description report_options_description();

/// Prints the summary (or the version) to `out`. Throws core::InputError: a file that is not a run's, an
/// output that cannot be written.
core::ExitCode run_report(const ReportOptions& options, std::ostream& out);

}  // namespace pbmpi::app
