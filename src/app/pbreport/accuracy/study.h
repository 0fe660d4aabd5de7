/// "pbreport [study] accuracy.h5": the cost of accuracy in time, and the setting to choose.
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "core/error.h"

namespace pbmpi::app {

/// Throws core::InputError: bad usage, a file that is no study, an output that cannot be written, a budget or
/// tolerance that no setting keeps when a file for --config is asked for.
core::ExitCode run_study(const std::vector<std::string>& args, std::ostream& out);

}  // namespace pbmpi::app
