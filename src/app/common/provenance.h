/// Where a run came from: what its file says of the program, the machine and the job.
#pragma once

#include <string>
#include <vector>

#include "mpi/comm/communicator.h"

namespace pbmpi::app {

/// Equal on every rank.
struct Provenance {
  std::string created;  ///< UTC, ISO 8601
  std::string command_line;
  std::vector<std::string> hosts;        ///< [num_ranks]
  int processors = 0;                    ///< online on root's host
  std::vector<std::string> environment;  ///< root's "NAME=value" of SLURM_* and OMPI_*
};

/// Collective. Root's clock and environment, and the hosts of all ranks.
Provenance collect_provenance(const mpi::Communicator& comm, const std::string& command_line);

/// Warns of hosts with more ranks x threads than processors, a line each; empty if there is none. The hosts
/// are taken to be like root's.
std::string shared_processors_warning(const std::string& program, const Provenance& provenance,
                                      int num_threads);

/// Each value once, in order of first appearance.
std::vector<std::string> distinct(const std::vector<std::string>& values);

}  // namespace pbmpi::app
