/// The studies that pbstudy can make, each in its folder.
#pragma once

#include <string>
#include <vector>

#include "core/error.h"
#include "mpi/comm/communicator.h"

namespace pbmpi::app {

/// A study. Collective; `args` follow its name. Throws core::InputError and core::RunError, the same on every
/// rank.
using Study = core::ExitCode(const mpi::Communicator& comm, const std::vector<std::string>& args);

Study run_accuracy;   ///< what accuracy costs in time
Study run_calibrate;  ///< the cost of the harness, without the physics
Study run_effects;    ///< the cost of each effect, and how leaving it out changes the result
Study run_stability;  ///< which settings pass the hard cases

}  // namespace pbmpi::app
