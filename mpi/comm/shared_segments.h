/// What killed runs leave in shared memory.
#pragma once

#include <string>
#include <vector>

namespace pbmpi::mpi {

/// MPI passes messages within a host through files of /dev/shm, and removes them when it ends. A killed run
/// leaves them, some 4 MiB a rank, until the host is booted. A record in /dev/shm, with PID namespace and
/// process in its name, says which of them MPI has made for this process; the next run on the host removes
/// what records of dead processes name. Records of other users are ignored. Nothing here ever fails: what
/// cannot be recorded, or removed, stays.
class SharedSegments {
 public:
  /// Call before MPI begins: removes what dead processes have left.
  SharedSegments();
  /// Call once MPI has begun: writes the record.
  void record();
  /// Call once MPI has ended: removes the record.
  void forget();

 private:
  std::vector<std::string> before_;  ///< mapped before MPI began
  std::string record_;
};

}  // namespace pbmpi::mpi
