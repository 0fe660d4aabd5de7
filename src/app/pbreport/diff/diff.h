/// "pbreport diff RUN REFERENCE": how far two recorded runs are apart.
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "core/error.h"

namespace pbmpi::app {

/// Throws core::InputError: bad usage, files that are not runs or do not describe the same bodies, a floor
/// run that is the reference itself.
core::ExitCode run_diff(const std::vector<std::string>& args, std::ostream& out);

}  // namespace pbmpi::app
