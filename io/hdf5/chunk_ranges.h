/// Where the rows of a chunked dataset stand in its file.
#pragma once

#include <vector>

#include "core/system/descriptor.h"
#include "io/hdf5/hdf5_handle.h"

namespace pbmpi::io {

/// The bytes of the rows [first, end) of a chunked dataset whose chunks are allocated and not filtered, as
/// far as it has so many rows. Where rows are cut into several chunks these count as a whole, if they begin
/// at `first` or behind it.
std::vector<core::ByteRange> bytes_of_rows(hid_t dataset, hsize_t first, hsize_t end);

/// Row at which the next chunk begins; `row` itself if it is the first of one.
hsize_t end_of_chunk(hid_t dataset, hsize_t row);

}  // namespace pbmpi::io
