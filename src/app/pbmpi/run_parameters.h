/// Parameters, attributes and optional columns of a run's file, and the plan of its steps.
#pragma once

#include <span>
#include <vector>

#include "app/common/provenance.h"
#include "app/pbmpi/work.h"
#include "effects/run_plan.h"
#include "io/run/run_file.h"

namespace pbmpi::app {

/// Collective. The plan of all worlds; `own`: those that this rank owns. The same on every rank.
effects::RunPlan gather_plan(const mpi::Communicator& comm, std::span<const stepping::LocalWorld> own);

/// The columns that only some runs' files have. `plan`: of all worlds.
io::OptionalColumns optional_columns(const Work& work, const effects::RunPlan& plan);

/// Attributes of the file's root. `plan`: of all worlds.
std::vector<io::Parameter> run_attributes(const Work& work, const Provenance& provenance,
                                          const effects::RunPlan& plan);

/// What the run's worlds change in the scene.
std::vector<io::WorldParameter> world_parameters(const Work& work);

/// /parameters: every resolved option, the scene's text, build and library versions, hosts, job environment.
std::vector<io::Parameter> run_parameters(const Work& work, const Provenance& provenance);

}  // namespace pbmpi::app
