/// What substeps and a warm start are worth at the time of 20 iterations.
#pragma once

#include "subjects.h"

namespace pbmpi::bench {

/// Simulates the subject by sor through `frames` frames with 1 substep x 20 iterations and with several
/// substeps of few iterations, with and without warm start, the settings taking turns frame by frame. Prints
/// for each the CPU time of a frame (each frame's least of several rounds, which the same bits repeat) and
/// its ratio to 1 x 20, the RMS gap over all joints of all frames and its ratio, the mean of the worlds'
/// worst gaps, the deepest contact of a world in the mean and of all, and the state hash.
void compare_substeps(const Subject& subject, int frames);

}  // namespace pbmpi::bench
