/// The ranks that write one file together.
#pragma once

namespace pbmpi::io {

/// This rank's place in the group, and the communicator with which the file is opened.
struct FileGroup {
  int fortran_communicator = 0;  ///< MPI_Comm_c2f of the ranks that write together
  int rank = 0;
  int num_ranks = 1;
};

}  // namespace pbmpi::io
