/// Finds where the rows of a chunked dataset lie in its file.
#pragma once

#include <vector>

#include "core/system/descriptor.h"
#include "io/hdf5/hdf5_handle.h"

namespace pbmpi::io {

/// The bytes of the rows [first, end) of a chunked dataset whose chunks are allocated and not filtered, as
/// far as it has that many rows. Where rows are cut into several chunks, a chunk counts as a whole if it
/// begins at `first` or after it.
std::vector<core::ByteRange> bytes_of_rows(hid_t dataset, hsize_t first, hsize_t end);

/// Row at which the next chunk begins; `row` itself if it is the first row of a chunk.
hsize_t end_of_chunk(hid_t dataset, hsize_t row);

}  // namespace pbmpi::io
