/// "pbstudy calibrate": the cost of the harness, without the physics.
#pragma once

#include <string>
#include <vector>

#include "core/error.h"
#include "mpi/comm/communicator.h"

namespace pbmpi::app {

/// Collective; `args` follow the word calibrate.
core::ExitCode run_calibrate(const mpi::Communicator& comm, const std::vector<std::string>& args);

}  // namespace pbmpi::app
