/// "pbreport figures FILE...": figures 8 and 9 of the paper from recorded runs.
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "app/manual/manual.h"
#include "core/error.h"

namespace pbmpi::app {

/// Throws core::InputError: bad usage, files that are not runs, a scene without its reference.
core::ExitCode run_figures(const std::vector<std::string>& args, std::ostream& out);
Manual figures_manual();

}  // namespace pbmpi::app
