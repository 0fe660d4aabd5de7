/// Which part of a dataset [rows][items][...] a rank writes, and how such a dataset is cut into chunks.
#pragma once

#include <cstdint>
#include <vector>

#include "io/hdf5_handle.h"

namespace pbmpi::io {

/// Neighbouring items of a row: [first, first + count).
struct Range {
  hsize_t first = 0;
  hsize_t count = 0;
  bool operator==(const Range&) const = default;
};

/// Adds a run behind the others; neighbours become one. Empty ranges are dropped.
void append_range(std::vector<Range>& ranges, hsize_t first, hsize_t count);

/// Items in all ranges.
hsize_t count_items(const std::vector<Range>& ranges);

/// Consecutive rows, in each of which this rank writes some ranges of items. Rows with the same ranges form
/// one block, so that without migration a whole flush is a few hyperslabs.
class RowBlocks {
 public:
  /// `row` follows the last one added; `ranges` are sorted.
  void add(std::int64_t row, const std::vector<Range>& ranges);
  void clear() { blocks_.clear(); }
  /// Selects these rows, less `first_row`, in `space` [rows] or [rows][items][...]; nothing if there is
  /// nothing to write.
  void select(const Dataspace& space, std::int64_t first_row) const;

 private:
  struct Block {
    std::int64_t first_row;
    std::int64_t num_rows;
    std::vector<Range> ranges;
  };
  std::vector<Block> blocks_;
};

/// Selects `ranges` of items in `space` [items][...].
void select_ranges(const Dataspace& space, const std::vector<Range>& ranges);

/// Chunks for `dims`, row first: whole rows of 1 to 4 MiB (a row beyond that is cut along its items), or the
/// whole dataset if it is smaller. Rows are spread evenly over the chunks, so that the last is not half
/// empty.
std::vector<hsize_t> chunk_shape(const std::vector<hsize_t>& dims, std::size_t element_bytes);

}  // namespace pbmpi::io
