/// "pbreport [report] FILE": the summary of one run, its page, its sidecar.
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "core/error.h"

namespace pbmpi::app {

/// Prints the summary to `out`. Throws core::InputError: bad usage, a file that is not a run's, an output
/// that cannot be written.
core::ExitCode run_report(const std::vector<std::string>& args, std::ostream& out);

}  // namespace pbmpi::app
