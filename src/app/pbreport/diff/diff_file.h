/// The HDF5 file of "pbreport diff --output".
#pragma once

#include "app/pbreport/diff/run_comparison.h"
#include "io/table/table_file.h"

namespace pbmpi::app {

inline constexpr const char* diff_filetype = "pbmpi-diff";

/// Tables /frames and /actors: errors and categories of each frame, and of each actor over all frames.
io::TableFile diff_file(const RunComparison& comparison, const std::string& run,
                        const std::string& reference);

}  // namespace pbmpi::app
