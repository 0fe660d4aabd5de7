#include "io/hdf5/chunk_ranges.h"

#include <algorithm>
#include <functional>
#include <numeric>

#include "core/error.h"

namespace pbmpi::io {
namespace {

struct Chunks {
  std::vector<hsize_t> dims, chunk;
  hsize_t row_bytes = 0;  ///< of one row of one chunk

  bool cut_rows() const { return dims.size() > 1 && chunk[1] < dims[1]; }
  hsize_t step_of_items() const { return dims.size() > 1 ? chunk[1] : 1; }
  hsize_t num_items() const { return dims.size() > 1 ? dims[1] : 1; }
};

Chunks chunks_of(hid_t dataset) {
  const auto space = owned<Dataspace>(H5Dget_space(dataset), "H5Dget_space");
  const auto creation = owned<PropertyList>(H5Dget_create_plist(dataset), "H5Dget_create_plist");
  const auto type = owned<Datatype>(H5Dget_type(dataset), "H5Dget_type");
  const int rank = H5Sget_simple_extent_ndims(space.id());
  check(rank < 1 ? -1 : 0, "H5Sget_simple_extent_ndims");
  Chunks chunks;
  chunks.dims.resize(static_cast<std::size_t>(rank));
  chunks.chunk.resize(static_cast<std::size_t>(rank));
  check(H5Sget_simple_extent_dims(space.id(), chunks.dims.data(), nullptr), "H5Sget_simple_extent_dims");
  check(H5Pget_chunk(creation.id(), rank, chunks.chunk.data()), "H5Pget_chunk");
  chunks.row_bytes = std::accumulate(chunks.chunk.begin() + 1, chunks.chunk.end(),
                                     hsize_t{H5Tget_size(type.id())}, std::multiplies<>());
  return chunks;
}

}  // namespace

void SpaceAhead::cover(hid_t file, const std::string& dataset, hsize_t needed, hsize_t ahead) {
  hsize_t& covered = covered_[dataset];
  if (needed <= covered) return;
  const auto opened =
      owned<Dataset>(H5Dopen2(file, dataset.c_str(), H5P_DEFAULT), "H5Dopen(" + dataset + ")");
  const std::string why = target_.reserve(bytes_of_rows(opened.id(), covered, needed + ahead));
  if (!why.empty()) throw core::RunError("no disk space for the next rows of " + dataset + ": " + why);
  covered = needed + ahead;
}

hsize_t end_of_chunk(hid_t dataset, hsize_t row) {
  const hsize_t rows = chunks_of(dataset).chunk[0];
  return (row + rows - 1) / rows * rows;
}

std::vector<core::ByteRange> bytes_of_rows(hid_t dataset, hsize_t first, hsize_t end) {
  const Chunks chunks = chunks_of(dataset);
  end = std::min(end, chunks.dims[0]);
  const hsize_t rows = chunks.chunk[0];
  std::vector<core::ByteRange> ranges;
  for (hsize_t begin = first - first % rows; begin < end; begin += rows) {
    if (chunks.cut_rows() && begin < first) continue;
    const hsize_t from = chunks.cut_rows() ? 0 : std::max(first, begin) - begin;
    const hsize_t to = chunks.cut_rows() ? rows : std::min(end, begin + rows) - begin;
    for (hsize_t item = 0; item < chunks.num_items(); item += chunks.step_of_items()) {
      std::vector<hsize_t> offset(chunks.dims.size(), 0);
      offset[0] = begin;
      if (offset.size() > 1) offset[1] = item;
      unsigned filters = 0;
      haddr_t address = HADDR_UNDEF;
      hsize_t bytes = 0;
      check(H5Dget_chunk_info_by_coord(dataset, offset.data(), &filters, &address, &bytes),
            "H5Dget_chunk_info_by_coord");
      if (address == HADDR_UNDEF) continue;
      ranges.emplace_back(address + from * chunks.row_bytes, (to - from) * chunks.row_bytes);
    }
  }
  return ranges;
}

}  // namespace pbmpi::io
