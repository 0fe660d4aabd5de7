/// Measures the value of substeps and of a memory against a step of 20 iterations of ODE's law.
#pragma once

#include "subjects.h"

namespace pbmpi::bench {

/// Simulates the subject with sor through `frames` frames: with ODE's law in 1 substep x 20 iterations, and
/// with its defaults at several numbers of substeps, and without memory, the settings alternating frame by
/// frame. Prints for each the CPU time of a frame (each frame's least over several rounds, which repeat the
/// same bits) and its ratio to the first, the RMS gap over all joints of all frames and its ratio, the mean
/// of the worlds' largest gaps, the deepest contact of a world (mean and maximum), and the state hash.
void compare_substeps(const Subject& subject, int frames);

}  // namespace pbmpi::bench
