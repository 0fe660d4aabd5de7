/// Writes a sample run on any number of ranks, for scripts that kill it, starve it or read what it wrote.
///   run_writer FILE PLANNED_FRAMES FRAMES RECORD_EVERY FLUSH_S MOVE PAUSE_US [LIMIT_BYTES]
/// MOVE > 0: every MOVE frames each world goes to the next rank. LIMIT_BYTES: from frame 3 on no byte beyond
/// this offset of a file can be written (RLIMIT_FSIZE). Prints "frame K" on root once frame K was handed
/// over.

#include <sys/resource.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <iostream>

#include "core/error.h"
#include "io/run/run_file.h"
#include "io/run/xdmf.h"
#include "mpi/comm/communicator.h"
#include "mpi/comm/session.h"
#include "sample_run.h"

namespace {

using namespace pbmpi;

struct Arguments {
  std::string path;
  long planned, frames, record_every;
  double flush_s;
  long move;
  unsigned pause_us;
  long limit_bytes;
};

Arguments parse(int argc, char** argv) {
  core::require_input(argc >= 8, "usage: see the head of run_writer.cpp");
  return {argv[1],
          std::atol(argv[2]),
          std::atol(argv[3]),
          std::atol(argv[4]),
          std::atof(argv[5]),
          std::atol(argv[6]),
          static_cast<unsigned>(std::atol(argv[7])),
          argc > 8 ? std::atol(argv[8]) : 0};
}

void limit_file_size(long bytes) {
  std::signal(SIGXFSZ, SIG_IGN);
  const rlimit limit{static_cast<rlim_t>(bytes), static_cast<rlim_t>(bytes)};
  core::require_input(setrlimit(RLIMIT_FSIZE, &limit) == 0, "setrlimit failed");
}

void write(const Arguments& arguments, const mpi::Communicator& comm) {
  io::test::Sample sample;
  sample.num_worlds = 20;
  sample.bodies_per_world = 8;
  sample.num_frames = arguments.planned;
  sample.record_every = static_cast<int>(arguments.record_every);
  sample.num_ranks = comm.size();
  sample.rank = comm.rank();
  sample.owner = [move = arguments.move, ranks = comm.size()](int world, std::int64_t frame) {
    return static_cast<int>((world + (move > 0 ? frame / move : 0)) % ranks);
  };
  const io::test::RankWorlds at_start(sample, 0);
  io::RunSetup setup = io::test::sample_setup(sample, at_start, arguments.path);
  setup.flush_interval_s = arguments.flush_s;
  io::RunFile file({comm.fortran_handle(), comm.rank(), comm.size()}, setup);
  for (std::int64_t frame = 0; frame < arguments.frames; ++frame) {
    if (frame == 3 && arguments.limit_bytes > 0) limit_file_size(arguments.limit_bytes);
    io::test::put_frame(file, sample, frame);
    if (frame % 4 == 1) file.event({frame, "rebalance", "moved worlds"});
    if (comm.is_root()) std::cout << "frame " << frame << std::endl;
    usleep(arguments.pause_us);
  }
  file.close(arguments.frames == arguments.planned, "0123456789abcdef");
  if (comm.is_root()) io::write_xdmf(arguments.path, arguments.path + ".xdmf");
}

}  // namespace

int main(int argc, char** argv) {
  mpi::Session session(argc, argv);
  const mpi::Communicator comm = mpi::Communicator::world();
  try {
    write(parse(argc, argv), comm);
    return 0;
  } catch (const core::InputError& error) {
    std::cerr << "rank " << comm.rank() << " input error: " << error.what() << std::endl;
    return 2;
  } catch (const core::RunError& error) {
    std::cerr << "rank " << comm.rank() << " run error: " << error.what() << std::endl;
    return 1;
  }
}
