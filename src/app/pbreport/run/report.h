/// "pbreport [report] FILE": the summary of one run, its page, its sidecar.
#pragma once

#include <iosfwd>

#include "app/pbreport/run/options.h"
#include "core/error.h"

namespace pbmpi::app {

/// Prints the summary (or the version) to `out`. Throws core::InputError: a file that is not a run's, an
/// output that cannot be written.
core::ExitCode run_report(const ReportOptions& options, std::ostream& out);

}  // namespace pbmpi::app
