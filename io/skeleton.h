/// All that a run's file holds before the first frame.
#pragma once

#include <cstdint>

#include "io/hdf5_handle.h"
#include "io/parallel_file.h"
#include "io/run_file.h"

namespace pbmpi::io {

/// Version of the file's layout (io/SCHEMA.md): the first number changes when old readers would be misled.
inline constexpr std::int64_t layout_major = 1;
inline constexpr std::int64_t layout_minor = 1;
inline constexpr const char* filetype = "pbmpi-run";

/// Writes the root's attributes, /h5md, /parameters and the static columns. Collective.
void write_skeleton(const FileRanks& ranks, hid_t file, const RunSetup& setup);

}  // namespace pbmpi::io
