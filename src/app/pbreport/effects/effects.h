/// "pbreport [effects] effects.h5": the cost of each effect, and the consequence of leaving it out.
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "core/error.h"

namespace pbmpi::app {

/// Throws core::InputError: bad usage, a file that is no study of effects, an output that cannot be written.
core::ExitCode run_effects_report(const std::vector<std::string>& args, std::ostream& out);

}  // namespace pbmpi::app
