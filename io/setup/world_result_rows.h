/// Group /world_results in the file.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "io/hdf5/hdf5_handle.h"
#include "io/setup/world_results.h"

namespace pbmpi::io {

/// Creates the columns, [num_worlds] each, with no row written yet. Part of the skeleton.
void create_world_results(hid_t file, int num_worlds);

/// Writes all rows, serially, and sets the group's attribute `num_worlds`, which marks them as written.
void write_world_results(hid_t file, std::span<const WorldResult> results);

/// [num_worlds]; none if the run did not come to its end, or the file has a layout before 1.6. Throws
/// core::RunError.
std::vector<WorldResult> read_world_results(hid_t file);

}  // namespace pbmpi::io
