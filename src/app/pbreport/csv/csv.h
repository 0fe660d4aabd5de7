/// "pbreport csv RUN": a table of a run as comma-separated values.
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "core/error.h"

namespace pbmpi::app {

/// Throws core::InputError: bad usage, a file that is not a run's, a table, body, actor or world that it does
/// not have.
core::ExitCode run_csv(const std::vector<std::string>& args, std::ostream& out);

}  // namespace pbmpi::app
