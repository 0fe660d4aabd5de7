/// "pbreport stability": the file of pbstudy stability.
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "core/error.h"

namespace pbmpi::app {

/// Throws core::InputError and core::RunError.
core::ExitCode run_stability_report(const std::vector<std::string>& args, std::ostream& out);

}  // namespace pbmpi::app
