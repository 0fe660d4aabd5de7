/// "pbreport scaling RUN...": what more ranks bring.
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "core/error.h"

namespace pbmpi::app {

/// Throws core::InputError: bad usage, no file of a run, no two runs of one work on different numbers of
/// ranks.
core::ExitCode run_scaling(const std::vector<std::string>& args, std::ostream& out);

}  // namespace pbmpi::app
