#include "mpi/comm/check.h"

#include <string>

#include "core/error.h"

namespace pbmpi::mpi {

void check(int code, const char* call, int rank) {
  if (code == MPI_SUCCESS) return;
  char text[MPI_MAX_ERROR_STRING] = "";
  int length = 0;
  if (MPI_Error_string(code, text, &length) != MPI_SUCCESS) length = 0;
  const std::string reason = length > 0 ? std::string(text, length) : "error code " + std::to_string(code);
  const std::string where = rank >= 0 ? " on rank " + std::to_string(rank) : "";
  throw core::RunError(std::string(call) + where + ": " + reason);
}

}  // namespace pbmpi::mpi
