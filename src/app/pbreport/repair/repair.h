/// "pbreport repair FILE": frees the disk space that a killed run still occupies.
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "app/manual/manual.h"
#include "core/error.h"

namespace pbmpi::app {

/// Throws core::InputError: bad usage, a file that is not a run's, or one that a run is still writing.
core::ExitCode run_repair(const std::vector<std::string>& args, std::ostream& out);
Manual repair_manual();

}  // namespace pbmpi::app
