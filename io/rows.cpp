#include "io/rows.h"

#include <algorithm>
#include <functional>
#include <numeric>

namespace pbmpi::io {
namespace {

std::vector<hsize_t> extent(const Dataspace& space) {
  std::vector<hsize_t> dims(static_cast<std::size_t>(std::max(H5Sget_simple_extent_ndims(space.id()), 0)));
  check(H5Sget_simple_extent_dims(space.id(), dims.data(), nullptr), "H5Sget_simple_extent_dims");
  return dims;
}

void unite(const Dataspace& space, const std::vector<hsize_t>& start, const std::vector<hsize_t>& count) {
  check(H5Sselect_hyperslab(space.id(), H5S_SELECT_OR, start.data(), nullptr, count.data(), nullptr),
        "H5Sselect_hyperslab");
}

}  // namespace

void append_range(std::vector<Range>& ranges, hsize_t first, hsize_t count) {
  if (count == 0) return;
  if (!ranges.empty() && ranges.back().first + ranges.back().count == first) {
    ranges.back().count += count;
  } else {
    ranges.push_back({first, count});
  }
}

hsize_t count_items(const std::vector<Range>& ranges) {
  hsize_t count = 0;
  for (const Range& range : ranges) count += range.count;
  return count;
}

void RowBlocks::add(std::int64_t row, const std::vector<Range>& ranges) {
  if (!blocks_.empty() && blocks_.back().first_row + blocks_.back().num_rows == row &&
      blocks_.back().ranges == ranges) {
    ++blocks_.back().num_rows;
  } else {
    blocks_.push_back({row, 1, ranges});
  }
}

void RowBlocks::select(const Dataspace& space, std::int64_t first_row) const {
  check(H5Sselect_none(space.id()), "H5Sselect_none");
  std::vector<hsize_t> count = extent(space);
  std::vector<hsize_t> start(count.size(), 0);
  for (const Block& block : blocks_) {
    start[0] = static_cast<hsize_t>(block.first_row - first_row);
    count[0] = static_cast<hsize_t>(block.num_rows);
    for (const Range& range : block.ranges) {
      if (count.size() > 1) {
        start[1] = range.first;
        count[1] = range.count;
      }
      unite(space, start, count);
    }
  }
}

void select_ranges(const Dataspace& space, const std::vector<Range>& ranges) {
  check(H5Sselect_none(space.id()), "H5Sselect_none");
  std::vector<hsize_t> count = extent(space);
  std::vector<hsize_t> start(count.size(), 0);
  for (const Range& range : ranges) {
    start[0] = range.first;
    count[0] = range.count;
    unite(space, start, count);
  }
}

std::vector<hsize_t> chunk_shape(const std::vector<hsize_t>& dims, std::size_t element_bytes) {
  constexpr hsize_t least_bytes = hsize_t{1} << 20;
  constexpr hsize_t most_bytes = hsize_t{4} << 20;
  std::vector<hsize_t> chunk = dims;
  const hsize_t row_bytes =
      std::accumulate(dims.begin() + 1, dims.end(), hsize_t{element_bytes}, std::multiplies<>());
  const hsize_t rows = std::max<hsize_t>(dims[0], 1);
  const hsize_t wanted = std::clamp<hsize_t>((least_bytes + row_bytes - 1) / row_bytes, 1, rows);
  const hsize_t num_chunks = std::max<hsize_t>(rows / wanted, 1);
  chunk[0] = (rows + num_chunks - 1) / num_chunks;
  if (row_bytes > most_bytes && dims.size() > 1) {
    const hsize_t pieces = (row_bytes + most_bytes - 1) / most_bytes;
    chunk[1] = (dims[1] + pieces - 1) / pieces;
  }
  return chunk;
}

}  // namespace pbmpi::io
