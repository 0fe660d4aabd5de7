/// pbmpi's ODE stepper against the bare loop, in one run.
#pragma once

#include "subjects.h"

namespace pbmpi::bench {

/// Simulates the subject `rounds` times from its start through its warm-up and `frames` frames, with the two
/// taking turns frame by frame (and taking turns at who goes first), and prints both rates and the median of
/// the frames' time ratios.
void compare(const Subject& subject, int frames, int rounds);

}  // namespace pbmpi::bench
