/// "pbreport join A B ... -o ALL": a run and the runs resumed from its checkpoints as one file.
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "app/manual/manual.h"
#include "core/error.h"

namespace pbmpi::app {

/// Throws core::InputError: bad usage, files that are not of one run, frames that are missing or differ.
core::ExitCode run_join(const std::vector<std::string>& args, std::ostream& out);
Manual join_manual();

}  // namespace pbmpi::app
