/// What the file of a run says of its options, and what it holds.
#pragma once

#include <vector>

#include "app/common/provenance.h"
#include "app/pbmpi/work.h"
#include "io/run/run_file.h"

namespace pbmpi::app {

/// What the run's file holds that not every file does.
io::OptionalColumns optional_columns(const Work& work);

/// Attributes of the file's root.
std::vector<io::Parameter> run_attributes(const Work& work, const Provenance& provenance);

/// /parameters: every resolved option, the scene's text, build and library versions, hosts, job environment.
std::vector<io::Parameter> run_parameters(const Work& work, const Provenance& provenance);

}  // namespace pbmpi::app
