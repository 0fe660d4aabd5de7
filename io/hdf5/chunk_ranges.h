/// Finds where the rows of a chunked dataset lie in its file, and reserves their space.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "core/system/descriptor.h"
#include "io/file/output_target.h"
#include "io/hdf5/hdf5_handle.h"

namespace pbmpi::io {

/// The bytes of the rows [first, end) of a chunked dataset whose chunks are allocated and not filtered, as
/// far as it has that many rows. Where rows are cut into several chunks, a chunk counts as a whole if it
/// begins at `first` or after it.
std::vector<core::ByteRange> bytes_of_rows(hid_t dataset, hsize_t first, hsize_t end);

/// Row at which the next chunk begins; `row` itself if it is the first row of a chunk.
hsize_t end_of_chunk(hid_t dataset, hsize_t row);

/// Reserves space for rows before they are written, so that a full disk ends the run between two writes. It
/// reserves at most one step ahead, so that a killed run keeps little unused space. Root only; borrows the
/// published file.
class SpaceAhead {
 public:
  explicit SpaceAhead(const OutputTarget& target) : target_(target) {}

  /// If `needed` rows of a dataset of `file` are not all covered, reserves space for them and `ahead` more.
  /// Throws core::RunError if the disk has no room.
  void cover(hid_t file, const std::string& dataset, hsize_t needed, hsize_t ahead);

 private:
  const OutputTarget& target_;
  std::map<std::string, hsize_t> covered_;  ///< rows covered, by dataset
};

}  // namespace pbmpi::io
