/// What substeps and a memory are worth beside a cold step of 20 iterations.
#pragma once

#include "subjects.h"

namespace pbmpi::bench {

/// Simulates the subject by sor through `frames` frames cold with 1 substep x 20 iterations, and as it is by
/// default with several numbers of substeps, and without memory, the settings taking turns frame by frame.
/// Prints for each the CPU time of a frame (each frame's least of several rounds, which the same bits repeat)
/// and its ratio to the first, the RMS gap over all joints of all frames and its ratio, the mean of the
/// worlds' worst gaps, the deepest contact of a world in the mean and of all, and the state hash.
void compare_substeps(const Subject& subject, int frames);

}  // namespace pbmpi::bench
