/// The program pbmpi, from the parsed command line to the printed summary.
#pragma once

#include <string>
#include <vector>

#include "core/error.h"
#include "mpi/comm/communicator.h"

namespace pbmpi::app {

/// Collective over `comm`. Throws core::InputError and core::RunError, the same on every rank.
core::ExitCode run_pbmpi(const mpi::Communicator& comm, const std::vector<std::string>& args);

}  // namespace pbmpi::app
