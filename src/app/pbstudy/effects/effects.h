/// "pbstudy effects": the cost of each effect, and how leaving it out changes the result.
#pragma once

#include <string>
#include <vector>

#include "core/error.h"
#include "mpi/comm/communicator.h"

namespace pbmpi::app {

/// Collective. Throws core::InputError and core::RunError, the same on every rank.
core::ExitCode run_effects(const mpi::Communicator& comm, const std::vector<std::string>& args);

}  // namespace pbmpi::app
