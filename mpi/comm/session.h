/// The life of MPI in a program.
#pragma once

#include <string>

#include "mpi/comm/shared_segments.h"

namespace pbmpi::mpi {

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
