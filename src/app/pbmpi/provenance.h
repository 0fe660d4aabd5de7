/// Where a run came from: what its file says of the program, the machine and the job.
#pragma once

#include <string>
#include <vector>

#include "app/pbmpi/options.h"
#include "io/run_file.h"
#include "mpi/communicator.h"

namespace pbmpi::app {

/// The same on every rank.
struct Provenance {
  std::string created;  ///< UTC, ISO 8601
  std::string command_line;
  std::vector<std::string> hosts;        ///< [num_ranks]
  std::vector<std::string> environment;  ///< root's "NAME=value" of SLURM_* and OMPI_*
};

/// Collective.
Provenance collect_provenance(const mpi::Communicator& comm, const std::string& command_line);

/// Each value once, in order of first appearance.
std::vector<std::string> distinct(const std::vector<std::string>& values);

/// What the run's file holds that not every file does.
io::OptionalColumns optional_columns(const scenes::Scene& scene, const RunSpec& spec);

/// Attributes of the file's root.
std::vector<io::Parameter> run_attributes(const scenes::Scene& scene, const RunSpec& spec,
                                          const Provenance& provenance);

/// /parameters: every resolved option, the scene's text, build and library versions, hosts, job environment.
std::vector<io::Parameter> run_parameters(const scenes::Scene& scene, const RunSpec& spec,
                                          const Provenance& provenance);

}  // namespace pbmpi::app
