/// The plan of a run, from what each rank knows of its own worlds.
#pragma once

#include <span>

#include "model/frame.h"
#include "model/run_plan.h"
#include "mpi/communicator.h"

namespace pbmpi::app {

/// Collective. `own`: the worlds that this rank owns. The same on every rank.
model::RunPlan gather_plan(const mpi::Communicator& comm, std::span<const model::LocalWorld> own);

}  // namespace pbmpi::app
