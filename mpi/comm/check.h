/// The one function through which pbmpi checks its MPI calls. Internal to this folder.
#pragma once

#include <mpi.h>

namespace pbmpi::mpi {

/// Throws core::RunError with the call's name, MPI's own message and the rank, unless `code` is MPI_SUCCESS.
/// Works because Session sets MPI_ERRORS_RETURN. `rank` < 0: not known.
void check(int code, const char* call, int rank = -1);

}  // namespace pbmpi::mpi
