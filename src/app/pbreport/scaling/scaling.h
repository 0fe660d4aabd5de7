/// "pbreport scaling RUN...": the gain from more ranks.
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "core/error.h"

namespace pbmpi::app {

/// Throws core::InputError: bad usage, a file that is not a run's, no two runs of one work on different
/// numbers of ranks.
core::ExitCode run_scaling(const std::vector<std::string>& args, std::ostream& out);

}  // namespace pbmpi::app
