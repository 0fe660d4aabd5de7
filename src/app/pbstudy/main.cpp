/// pbstudy: runs a matrix of cases over the ranks, and writes the cost and quality of each.
#include "app/common/options.h"
#include "app/common/run_program.h"
#include "app/pbstudy/commands.h"
#include "core/system/leftovers.h"
#include "mpi/comm/session.h"

int main(int argc, char** argv) {
  pbmpi::core::remove_leftovers_on_signals();
  const pbmpi::mpi::Session session(argc, argv);
  return pbmpi::app::run_program("pbstudy", [&](const pbmpi::mpi::Communicator& world) {
    return pbmpi::app::run_pbstudy(world, pbmpi::app::arguments(argc, argv));
  });
}
