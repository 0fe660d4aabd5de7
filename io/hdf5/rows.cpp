#include "io/hdf5/rows.h"

#include <algorithm>
#include <functional>
#include <numeric>

namespace pbmpi::io {

std::vector<hsize_t> extent_of(const Dataspace& space) {
  std::vector<hsize_t> dims(static_cast<std::size_t>(std::max(H5Sget_simple_extent_ndims(space.id()), 0)));
  check(H5Sget_simple_extent_dims(space.id(), dims.data(), nullptr), "H5Sget_simple_extent_dims");
  return dims;
}

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

Range share_of_rows(hsize_t num_rows, int rank, int num_ranks) {
  const auto begin_of = [=](int r) {
    return num_rows * static_cast<hsize_t>(r) / static_cast<hsize_t>(num_ranks);
  };
  return {begin_of(rank), begin_of(rank + 1) - begin_of(rank)};
}

void select_ranges(const Dataspace& space, const std::vector<Range>& ranges) {
  check(H5Sselect_none(space.id()), "H5Sselect_none");
  std::vector<hsize_t> count = extent_of(space);
  std::vector<hsize_t> start(count.size(), 0);
  for (const Range& range : ranges) {
    start[0] = range.first;
    count[0] = range.count;
    check(H5Sselect_hyperslab(space.id(), H5S_SELECT_OR, start.data(), nullptr, count.data(), nullptr),
          "H5Sselect_hyperslab");
  }
}

Dataspace select_rows(const Dataspace& in_file, Range rows) {
  std::vector<hsize_t> count = extent_of(in_file);
  std::vector<hsize_t> start(count.size(), 0);
  if (!count.empty()) {  // a scalar counts as one row
    start[0] = rows.first;
    count[0] = std::max<hsize_t>(rows.count, 1);
  }
  auto in_memory = owned<Dataspace>(H5Screate_simple(static_cast<int>(count.size()), count.data(), nullptr),
                                    "H5Screate_simple");
  if (rows.count == 0) {
    check(H5Sselect_none(in_file.id()), "H5Sselect_none");
    check(H5Sselect_none(in_memory.id()), "H5Sselect_none");
  } else if (!count.empty()) {
    check(H5Sselect_hyperslab(in_file.id(), H5S_SELECT_SET, start.data(), nullptr, count.data(), nullptr),
          "H5Sselect_hyperslab");
  }
  return in_memory;
}

void write_rows(const Dataset& dataset, hid_t type, Range rows, const void* values, const std::string& path) {
  if (rows.count == 0) return;
  const auto in_file = owned<Dataspace>(H5Dget_space(dataset.id()), "H5Dget_space");
  const Dataspace in_memory = select_rows(in_file, rows);
  check(H5Dwrite(dataset.id(), type, in_memory.id(), in_file.id(), H5P_DEFAULT, values),
        "H5Dwrite(" + path + ")");
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
