/// pbmpi's steppers against the bare ODE loop, in one run.
#pragma once

#include "subjects.h"

namespace pbmpi::bench {

/// Simulates the subject `rounds` times from its start through its warm-up and `frames` frames, the steppers
/// taking turns frame by frame, and prints for each its rate, its median time ratio to the bare loop and its
/// state hash. Needs an mpi::Session.
void compare(const Subject& subject, int frames, int rounds);

}  // namespace pbmpi::bench
