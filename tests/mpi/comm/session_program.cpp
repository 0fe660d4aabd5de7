/// A program in which one rank fails while the others wait for it: `unwind` with an exception through the
/// session (exit code 4), `abort` with Session::abort (exit code 3).

#include <cstdio>
#include <exception>
#include <stdexcept>
#include <string_view>

#include "mpi/comm/communicator.h"
#include "mpi/comm/session.h"

namespace {

void fail_on_the_last_rank(bool unwind) {
  const pbmpi::mpi::Communicator world = pbmpi::mpi::Communicator::world();
  if (world.rank() == world.size() - 1) {
    if (unwind) throw std::runtime_error("this rank alone fails");
    pbmpi::mpi::Session::abort(3);
  }
  world.barrier();  // waits for ever, unless the launcher ends it
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const pbmpi::mpi::Session session(argc, argv);
    fail_on_the_last_rank(argc > 1 && std::string_view(argv[1]) == "unwind");
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 4;
  }
  return 0;
}
