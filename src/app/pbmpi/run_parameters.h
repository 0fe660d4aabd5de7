/// Parameters, attributes and optional columns of a run's file.
#pragma once

#include <vector>

#include "app/common/provenance.h"
#include "app/pbmpi/work.h"
#include "io/run/run_file.h"

namespace pbmpi::app {

/// The columns that only some runs' files have.
io::OptionalColumns optional_columns(const Work& work);

/// Attributes of the file's root.
std::vector<io::Parameter> run_attributes(const Work& work, const Provenance& provenance);

/// /parameters: every resolved option, the scene's text, build and library versions, hosts, job environment.
std::vector<io::Parameter> run_parameters(const Work& work, const Provenance& provenance);

}  // namespace pbmpi::app
