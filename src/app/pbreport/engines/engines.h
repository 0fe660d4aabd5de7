/// "pbreport engines": the files of pbstudy accuracy and pbstudy stability, engine by engine.
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "app/manual/manual.h"
#include "core/error.h"

namespace pbmpi::app {

/// Throws core::InputError and core::RunError.
core::ExitCode run_engines(const std::vector<std::string>& args, std::ostream& out);
Manual engines_manual();

}  // namespace pbmpi::app
