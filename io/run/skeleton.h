/// Everything that a run's file holds before the first frame.
#pragma once

#include <cstdint>

#include "io/hdf5/hdf5_handle.h"
#include "io/hdf5/parallel_file.h"
#include "io/run/run_file.h"

namespace pbmpi::io {

/// Writes the root's attributes, /h5md, /parameters and the static columns. Collective.
void write_skeleton(const FileRanks& ranks, hid_t file, const RunSetup& setup);

}  // namespace pbmpi::io
