/// Steps a batch as a C++ program does, on request: `batch_loop SCENE WORLDS PRECISION THREADS`. For each
/// input line "FRAMES" it steps so many frames, reads the poses after each, and prints "SECONDS HASH HEIGHT".
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <exception>
#include <iostream>
#include <string>
#include <vector>

#include "pbmpi/batch.h"

namespace {

/// Processor time of all threads [s].
double processor_s() {
  timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

void serve(const pbmpi::BatchOptions& options) {
  pbmpi::Batch batch(options);
  batch.step(batch.steps_per_frame());
  const std::vector<std::byte> first_frame = batch.save();
  for (int frames = 0; std::cin >> frames;) {
    batch.load(first_frame);
    double height = 0;
    const double start_s = processor_s();
    for (int frame = 0; frame < frames; ++frame) {
      batch.step(batch.steps_per_frame());
      height += batch.state().position[2];
    }
    const double seconds = processor_s() - start_s;
    std::printf("%.9f %016llx %g\n", seconds, static_cast<unsigned long long>(batch.hash()), height);
    std::fflush(stdout);
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 5) {
    std::fputs("usage: batch_loop SCENE WORLDS PRECISION THREADS\n", stderr);
    return 2;
  }
  try {
    pbmpi::BatchOptions options;
    options.scene = argv[1];
    options.num_worlds = std::atoi(argv[2]);
    options.settings = {{"precision", argv[3]}, {"threads", argv[4]}};
    serve(options);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "batch_loop: %s\n", error.what());
    return 1;
  }
}
