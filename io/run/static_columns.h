/// The columns that are written once: bodies, geoms, ranks.
#pragma once

#include "io/hdf5/hdf5_handle.h"
#include "io/hdf5/parallel_file.h"
#include "io/run/run_file.h"

namespace pbmpi::io {

/// Makes and writes /particles/bodies (without the moving part), /geoms and /ranks. Collective.
void write_static_columns(const FileRanks& ranks, hid_t file, const RunSetup& setup);

}  // namespace pbmpi::io
