/// "pbreport repair FILE": gives back the disk space that a killed run keeps.
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "app/manual/manual.h"
#include "core/error.h"

namespace pbmpi::app {

/// Throws core::InputError: bad usage, no file of a run, one that a run still writes.
core::ExitCode run_repair(const std::vector<std::string>& args, std::ostream& out);
Manual repair_manual();

}  // namespace pbmpi::app
