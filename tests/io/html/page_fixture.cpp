/// Writes the page of an artificial run: page_fixture OUT WORLDS FRAMES MAX_POSE_BYTES.
#include <cstdlib>
#include <iostream>

#include "io/html/page.h"
#include "page_sample.h"

int main(int argc, char** argv) {
  using namespace pbmpi::io::html;
  if (argc != 5) {
    std::cerr << "usage: page_fixture OUT WORLDS FRAMES MAX_POSE_BYTES\n";
    return 2;
  }
  SampleSize size;
  size.num_worlds = std::atoi(argv[2]);
  size.num_records = std::atoi(argv[3]);
  PageOptions options;
  options.max_pose_bytes = std::atoll(argv[4]);
  options.facts = {{"Size", "204 bodies", "in 4 worlds"},
                   {"Ranks", "2", "on 1 host"},
                   {"Stepper", "quick", "20 iterations, dt 10 ms"},
                   {"Frame rate", "398 Hz", "harmonic mean of 5 frames"},
                   {"Within budget", "80 %", "of frames in 3.33 ms"},
                   {"Frame time", "2.10 ms", "median; p99 4.10, max 4.20"},
                   {"Efficiency", "76 %", "balance 95 % × comm. 80 %"},
                   {"Invariants", "0.80 mm", "joint gap; penetration 2.00 mm"}};
  write_page(argv[1], sample_run(size), options);
}
