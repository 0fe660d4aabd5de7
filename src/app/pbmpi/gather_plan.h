/// Combines what each rank knows of its own worlds into the plan of a run.
#pragma once

#include <span>

#include "effects/run_plan.h"
#include "mpi/comm/communicator.h"
#include "stepping/frame.h"

namespace pbmpi::app {

/// Collective. `own`: the worlds that this rank owns. The same on every rank.
effects::RunPlan gather_plan(const mpi::Communicator& comm, std::span<const stepping::LocalWorld> own);

}  // namespace pbmpi::app
