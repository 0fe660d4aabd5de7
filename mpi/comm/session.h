/// The life of MPI in a program.
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

/// Starts MPI, and ends it with the scope. Create one per program, first thing in main(). From then on MPI's
/// calls return errors, which the wrappers turn into exceptions.
///
/// While an exception unwinds through the session MPI is not finalised: MPI_Finalize waits for ranks that may
/// wait for this one in another call. The launcher then sees a rank end without MPI_Finalize and ends the
/// others. Errors on which all ranks agreed are therefore best caught inside the session's scope.
class Session {
 public:
  /// Throws core::RunError if MPI cannot start. Takes MPI's own arguments out of argv.
  Session(int& argc, char**& argv);
  ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  /// Ends all ranks with this exit code at once: for main(), when only this rank met an error.
  [[noreturn]] static void abort(int exit_code);

 private:
  int exceptions_at_start_;
  SharedSegments segments_;
};

/// Name and version of the MPI library, one line. Needs no session.
std::string library_version();

}  // namespace pbmpi::mpi
