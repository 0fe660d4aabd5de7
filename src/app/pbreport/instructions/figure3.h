/// "pbreport figure3 figure3.json": the paper's Figure 3 and the mix of instructions.
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "app/manual/manual.h"
#include "core/error.h"

namespace pbmpi::app {

/// Throws core::InputError: bad usage, or files that are neither counts nor runs with --record-islands.
core::ExitCode run_figure3(const std::vector<std::string>& args, std::ostream& out);
Manual figure3_manual();

}  // namespace pbmpi::app
