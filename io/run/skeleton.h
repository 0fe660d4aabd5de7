/// Everything that a run's file holds before the first frame.
#pragma once

#include <string>

#include "io/hdf5/file_ranks.h"
#include "io/hdf5/hdf5_handle.h"
#include "io/run/run_file.h"

namespace pbmpi::io {

/// Root makes the file with all its datasets, at their full length, and everything but the values of static
/// and growing columns. Collective; throws the same core::RunError on every rank.
void make_skeleton(const FileRanks& ranks, const std::string& path, const RunSetup& setup,
                   const RunShape& shape);

/// Writes the static columns of the file, which all ranks have open. Collective; throws as make_skeleton()
/// does.
void fill_skeleton(const FileRanks& ranks, hid_t file, const RunSetup& setup);

}  // namespace pbmpi::io
