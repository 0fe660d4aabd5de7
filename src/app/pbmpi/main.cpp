/// pbmpi: simulates one scene over the ranks, writes one HDF5 file, prints the summary.
#include "app/common/options.h"
#include "app/common/run_program.h"
#include "app/pbmpi/run.h"
#include "mpi/comm/session.h"

int main(int argc, char** argv) {
  const pbmpi::mpi::Session session(argc, argv);
  return pbmpi::app::run_program("pbmpi", [&](const pbmpi::mpi::Communicator& world) {
    return pbmpi::app::run_pbmpi(world, pbmpi::app::arguments(argc, argv));
  });
}
