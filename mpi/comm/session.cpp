#include "mpi/comm/session.h"

#include <cstdlib>
#include <exception>

#include "core/system/awaited.h"
#include "mpi/comm/check.h"

namespace pbmpi::mpi {
namespace {

/// Makes Open MPI open files without shared file pointers, which nothing here uses: the component "sm"
/// creates a semaphore on the host that is named after the last part of the file's name. A semaphore held by
/// a killed run makes each later run of that name wait for ever, and two runs of one name share it. Files are
/// opened without shared pointers if the only component of that framework has a negative priority; without
/// any component they could not be opened.
void do_without_shared_file_pointers() {
  setenv("OMPI_MCA_sharedfp", "sm", 1);
  setenv("OMPI_MCA_sharedfp_sm_priority", "-1", 1);
}

}  // namespace

Session::Session(int& argc, char**& argv) : exceptions_at_start_(std::uncaught_exceptions()) {
  do_without_shared_file_pointers();
  const core::Awaited all_ranks("all ranks to start (MPI_Init)");
  int provided = 0;
  // Before MPI_Init there is no error handler to set: MPI aborts by itself if it cannot start.
  check(MPI_Init_thread(&argc, &argv, MPI_THREAD_FUNNELED, &provided), "MPI_Init_thread");
  check(MPI_Comm_set_errhandler(MPI_COMM_WORLD, MPI_ERRORS_RETURN), "MPI_Comm_set_errhandler");
  check(MPI_Comm_set_errhandler(MPI_COMM_SELF, MPI_ERRORS_RETURN), "MPI_Comm_set_errhandler");
  segments_.record();
}

Session::~Session() {
  if (std::uncaught_exceptions() > exceptions_at_start_) return;
  const core::Awaited all_ranks("all ranks to end (MPI_Finalize)");
  MPI_Finalize();  // a destructor has nobody to report an error to
  segments_.forget();
}

void Session::abort(int exit_code) {
  MPI_Abort(MPI_COMM_WORLD, exit_code);
  std::_Exit(exit_code);  // MPI_Abort does not promise not to return
}

std::string library_version() {
  char text[MPI_MAX_LIBRARY_VERSION_STRING] = "";
  int length = 0;
  check(MPI_Get_library_version(text, &length), "MPI_Get_library_version");
  const std::string version(text, length);
  return version.substr(0, version.find_first_of(",\n"));
}

}  // namespace pbmpi::mpi
