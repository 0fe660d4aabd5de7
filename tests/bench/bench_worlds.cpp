/// bench_worlds [SUBJECT] [WORLDS] [FRAMES] [ROUNDS]: pbmpi's steppers against the bare ODE loop over the
/// same worlds. bench_worlds --spaces: ODE's spaces against each other. bench_worlds --effects: what effects
/// cost. bench_worlds --guards: what guards cost. bench_worlds --sleeping: what sleeping saves. bench_worlds
/// --substeps [SUBJECT] [WORLDS] [FRAMES]: substeps and memory against iterations. bench_worlds --quiet
/// [SUBJECT] [SECONDS] [MICROMETRES]: what a tolerance saves from that time on.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "compare.h"
#include "core/error.h"
#include "effects.h"
#include "guards.h"
#include "mpi/comm/session.h"
#include "rest/quiet.h"
#include "rest/sleeping.h"
#include "spaces.h"
#include "substeps.h"

namespace {

int number(int argc, char** argv, int index, int otherwise) {
  if (index >= argc) return otherwise;
  char* end = nullptr;
  const long value = std::strtol(argv[index], &end, 10);
  pbmpi::core::require_input(*end == '\0' && value >= 0 && value < 1000000,
                             std::string("'") + argv[index] + "' is no count; give a whole number");
  return static_cast<int>(value);
}

void run(int argc, char** argv) {
  const std::string name = argc > 1 ? argv[1] : "100CrSk";
  if (name == "--spaces") {
    pbmpi::bench::compare_spaces();
    return;
  }
  if (name == "--effects") {
    pbmpi::bench::compare_effects();
    return;
  }
  if (name == "--guards") {
    pbmpi::bench::compare_guards();
    return;
  }
  if (name == "--sleeping") {
    pbmpi::bench::compare_sleeping();
    return;
  }
  if (name == "--substeps") {
    const std::string scene = argc > 2 ? argv[2] : "100CrSk";
    const auto subject = pbmpi::bench::load_subject(scene, number(argc, argv, 3, 0));
    pbmpi::bench::compare_substeps(subject, std::max(1, number(argc, argv, 4, 100)));
    return;
  }
  if (name == "--quiet") {
    const auto subject = pbmpi::bench::load_subject(argc > 2 ? argv[2] : "Environ", 0);
    pbmpi::bench::compare_quiet(subject, number(argc, argv, 3, 5), 1e-6 * number(argc, argv, 4, 10));
    return;
  }
  const auto subject = pbmpi::bench::load_subject(name, number(argc, argv, 2, 0));
  const int frames = number(argc, argv, 3, 20);
  const int rounds = number(argc, argv, 4, 5);
  pbmpi::core::require_input(frames > 0 && rounds > 0,
                             "frames and rounds: nothing to measure; give at least 1");
  pbmpi::bench::compare(subject, frames, rounds);
}

}  // namespace

int main(int argc, char** argv) {
  const pbmpi::mpi::Session session(argc, argv);
  try {
    run(argc, argv);
    return static_cast<int>(pbmpi::core::ExitCode::done);
  } catch (const pbmpi::core::InputError& error) {
    std::fprintf(stderr, "bench_worlds: %s\n", error.what());
    return static_cast<int>(pbmpi::core::ExitCode::bad_input);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "bench_worlds: %s\n", error.what());
    return static_cast<int>(pbmpi::core::ExitCode::failed);
  }
}
