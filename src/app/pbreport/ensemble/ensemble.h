/// "pbreport ensemble RUN...": runs of one scene that differ in their seeds.
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "core/error.h"

namespace pbmpi::app {

/// Throws core::InputError: bad usage, files that are not runs or not of one ensemble.
core::ExitCode run_ensemble(const std::vector<std::string>& args, std::ostream& out);

}  // namespace pbmpi::app
