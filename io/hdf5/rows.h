/// Selects rows and items of datasets, to read and to write them, and cuts datasets [rows][items][...] into
/// chunks.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "io/hdf5/hdf5_handle.h"

namespace pbmpi::io {

/// Consecutive items of a row, or consecutive rows: [first, first + count).
struct Range {
  hsize_t first = 0;
  hsize_t count = 0;
  bool operator==(const Range&) const = default;
};

/// The dimensions of a dataspace, row first; empty for a scalar.
std::vector<hsize_t> extent_of(const Dataspace& space);

/// Appends a range; if it begins where the last one ends, the two are merged. Empty ranges are dropped.
void append_range(std::vector<Range>& ranges, hsize_t first, hsize_t count);

/// Items in all ranges.
hsize_t count_items(const std::vector<Range>& ranges);

/// The rows that each of `num_ranks` ranks writes out of `num_rows`: nearly equal shares, in order of the
/// ranks.
Range share_of_rows(hsize_t num_rows, int rank, int num_ranks);

/// Selects `ranges` of items in `space` [items][...].
void select_ranges(const Dataspace& space, const std::vector<Range>& ranges);

/// Selects these rows of a dataset [rows][...] in `in_file`, and returns the space that they take in memory.
Dataspace select_rows(const Dataspace& in_file, Range rows);

/// Writes rows of a dataset, `values` in the memory type `type`. `path`: of the dataset, for errors.
void write_rows(const Dataset& dataset, hid_t type, Range rows, const void* values, const std::string& path);

/// Chunks for `dims`, row first: whole rows of 1 to 4 MiB (a row beyond that is cut along its items), or the
/// whole dataset if it is smaller. Rows are spread evenly over the chunks, so the last is not half empty.
std::vector<hsize_t> chunk_shape(const std::vector<hsize_t>& dims, std::size_t element_bytes);

}  // namespace pbmpi::io
