/// pbmpi's steppers against the bare ODE loop, in one run.
#pragma once

#include "subjects.h"

namespace pbmpi::bench {

/// Simulates the subject `rounds` times from its start through its warm-up and `frames` frames, with the
/// steppers alternating frame by frame. Prints each stepper's rate, median time ratio to the bare loop, and
/// state hash. Needs an mpi::Session.
void compare(const Subject& subject, int frames, int rounds);

}  // namespace pbmpi::bench
