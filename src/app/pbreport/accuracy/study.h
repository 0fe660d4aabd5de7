/// "pbreport [study] accuracy.h5": what accuracy costs in time, and which setting to take.
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "core/error.h"

namespace pbmpi::app {

/// Throws core::InputError: bad usage, a file that is no study, an output that cannot be written, a budget or
/// tolerance that no setting keeps where a preset is asked for.
core::ExitCode run_study(const std::vector<std::string>& args, std::ostream& out);

}  // namespace pbmpi::app
