/// "pbreport islands FILE...": the paper's Table 1 beside runs.
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "app/manual/manual.h"
#include "core/error.h"

namespace pbmpi::app {

/// Throws core::InputError: bad usage, or files that are not runs.
core::ExitCode run_islands(const std::vector<std::string>& args, std::ostream& out);
Manual islands_manual();

}  // namespace pbmpi::app
