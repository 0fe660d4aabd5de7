#include "io/hdf5/growing_columns.h"

#include <algorithm>
#include <span>

#include "core/system/seal.h"
#include "io/hdf5/columns.h"
#include "io/hdf5/file_checksum.h"

namespace pbmpi::io {
namespace {

Datatype type_of(const ColumnSpec& column) {
  return column.text_bytes > 0 ? text_type(column.text_bytes) : number_type(column.native_type);
}

/// [rows] or [rows][items] or [rows][items][width]
std::vector<hsize_t> table_dims(hsize_t rows, hsize_t items, hsize_t width) {
  std::vector<hsize_t> dims{rows};
  if (items > 0) dims.push_back(items);
  if (width > 1) dims.push_back(width);
  return dims;
}

/// Adds the bytes of the chunks that lie entirely after row `num_rows`.
void add_unused_chunks(hid_t dataset, hsize_t num_rows, std::vector<core::ByteRange>& unused) {
  const auto space = owned<Dataspace>(H5Dget_space(dataset), "H5Dget_space");
  hsize_t num_chunks = 0;
  check(H5Dget_num_chunks(dataset, space.id(), &num_chunks), "H5Dget_num_chunks");
  for (hsize_t chunk = 0; chunk < num_chunks; ++chunk) {
    std::vector<hsize_t> offset(H5S_MAX_RANK);
    unsigned filters = 0;
    haddr_t address = HADDR_UNDEF;
    hsize_t bytes = 0;
    check(H5Dget_chunk_info(dataset, space.id(), chunk, offset.data(), &filters, &address, &bytes),
          "H5Dget_chunk_info");
    if (offset[0] >= num_rows) unused.emplace_back(address, bytes);
  }
}

}  // namespace

std::vector<std::string> GrowingTable::datasets(const std::string& group,
                                                const std::vector<ColumnSpec>& columns) {
  std::vector<std::string> paths;
  paths.reserve(columns.size() + 1);
  for (const ColumnSpec& column : columns) paths.push_back(group + "/" + column.name);
  paths.push_back(row_checksum_path(paths.front()));
  return paths;
}

void GrowingTable::create(hid_t file, const std::string& group, const std::vector<ColumnSpec>& columns,
                          TableShape shape) {
  const auto make = [&](const std::string& path, const Datatype& type, hsize_t num_items, hsize_t width,
                        const std::string& unit) {
    return create_growing(file, path, type, table_dims(shape.num_rows, num_items, width), unit);
  };
  std::string paths;
  for (const ColumnSpec& spec : columns) paths += group + "/" + spec.name + "\n";
  // The checksums are created first: the last dataset in the file is dropped when a run is cut, if it is
  // large.
  const Dataset checksums =
      make(row_checksum_path(group + "/" + columns.front().name), number_type(H5T_NATIVE_UINT64), 0, 1, "");
  write_attribute(checksums.id(), "columns", paths);
  for (const ColumnSpec& spec : columns)
    make(group + "/" + spec.name, type_of(spec), shape.num_items, spec.width, spec.unit);
}

GrowingTable::GrowingTable(hid_t file, const FileRanks& ranks, const std::string& group,
                           const std::vector<ColumnSpec>& columns, TableShape shape)
    : ranks_(ranks), shape_(shape), items_(std::max<hsize_t>(shape.num_items, 1)) {
  shape_.capacity = std::clamp<hsize_t>(shape.capacity, 1, std::max<hsize_t>(shape.num_rows, 1));
  for (const ColumnSpec& spec : columns)
    columns_.push_back(
        open_column(file, group + "/" + spec.name, type_of(spec), shape.num_items, spec.width));
  columns_.push_back(open_column(file, row_checksum_path(group + "/" + columns.front().name),
                                 number_type(H5T_NATIVE_UINT64), 0, 1));
}

GrowingTable::Column GrowingTable::open_column(hid_t file, const std::string& path, const Datatype& type,
                                               hsize_t num_items, hsize_t width) const {
  Column column{path,
                owned<Datatype>(H5Tcopy(type.id()), "H5Tcopy"),
                owned<Dataset>(H5Dopen2(file, path.c_str(), H5P_DEFAULT), "H5Dopen(" + path + ")"),
                H5Tget_size(type.id()) * width,
                std::max<hsize_t>(num_items, 1),
                nullptr};
  // Not value-initialised: see the class comment.
  column.waiting.reset(new std::byte[shape_.capacity * column.items * column.item_bytes]);
  return column;
}

void GrowingTable::add_checksums(Range rows) {
  for (hsize_t row = rows.first; row < rows.first + rows.count; ++row) {
    core::Checksum sum;
    for (Column& column : own_columns()) sum.add({place(column, row, 0), column.items * column.item_bytes});
    const std::uint64_t value = sum.value();
    std::memcpy(place(columns_.back(), row, 0), &value, sizeof value);
  }
}

void GrowingTable::begin_row(const std::vector<Range>& ranges) {
  core::require_invariant(!full() && written_ + num_waiting_ < shape_.num_rows, "a row too many");
  owned_.push_back(ranges);
  ++num_waiting_;
}

void GrowingTable::put_text(std::size_t column, const std::string& text) {
  std::string padded = cut_text(text, columns_[column].item_bytes);
  padded.resize(columns_[column].item_bytes, '\0');
  std::memcpy(place(column, 0), padded.data(), padded.size());
}

std::size_t GrowingTable::row_bytes(const std::vector<ColumnSpec>& columns, hsize_t num_items) {
  std::size_t bytes = 0;
  for (const ColumnSpec& column : columns) {
    const std::size_t value = column.text_bytes > 0 ? column.text_bytes : H5Tget_size(column.native_type);
    bytes += value * column.width * std::max<hsize_t>(num_items, 1);
  }
  return bytes + sizeof(std::uint64_t);  // with the row's checksum
}

void GrowingTable::pack(hsize_t row, std::vector<std::byte>& message) {
  const auto append = [&message](const void* data, std::size_t bytes) {
    const auto* begin = static_cast<const std::byte*>(data);
    message.insert(message.end(), begin, begin + bytes);
  };
  const std::vector<Range>& ranges = owned_[row];
  const std::size_t num_ranges = ranges.size();
  append(&num_ranges, sizeof num_ranges);
  append(ranges.data(), num_ranges * sizeof(Range));
  for (Column& column : own_columns()) {
    for (const Range& range : ranges)
      append(place(column, row, range.first), range.count * column.item_bytes);
  }
}

const std::byte* GrowingTable::unpack(hsize_t row, const std::byte* message) {
  const auto take = [&message](void* data, std::size_t bytes) {
    if (bytes > 0) std::memcpy(data, message, bytes);
    message += bytes;
  };
  std::size_t num_ranges = 0;
  take(&num_ranges, sizeof num_ranges);
  std::vector<Range> ranges(num_ranges);
  take(ranges.data(), num_ranges * sizeof(Range));
  for (Column& column : own_columns()) {
    for (const Range& range : ranges) take(place(column, row, range.first), range.count * column.item_bytes);
  }
  return message;
}

void GrowingTable::settle() {
  if (ranks_.size() == 1 || num_waiting_ == 0) return;
  std::vector<std::vector<std::byte>> messages(static_cast<std::size_t>(ranks_.size()));
  for (int to = 0; to < ranks_.size(); ++to) {
    if (to == ranks_.rank()) continue;
    const Range rows = share_of_rows(num_waiting_, to, ranks_.size());
    for (hsize_t row = rows.first; row < rows.first + rows.count; ++row) pack(row, messages[to]);
  }
  const std::vector<std::byte> received = ranks_.exchange(messages);
  const Range own = share_of_rows(num_waiting_, ranks_.rank(), ranks_.size());
  const std::byte* message = received.data();
  for (int from = 0; from < ranks_.size(); ++from) {
    if (from == ranks_.rank()) continue;
    for (hsize_t row = own.first; row < own.first + own.count; ++row) message = unpack(row, message);
  }
}

void GrowingTable::write() {
  const Range rows = share_of_rows(num_waiting_, ranks_.rank(), ranks_.size());
  add_checksums(rows);
  for (Column& column : columns_)
    write_rows(column.dataset, column.type.id(), {written_ + rows.first, rows.count},
               place(column, rows.first, 0), column.path);
  owned_.clear();
  written_ += num_waiting_;
  num_waiting_ = 0;
}

void GrowingTable::close() {
  for (Column& column : columns_) column.dataset.close();
}

void GrowingTable::cut(hid_t file, std::vector<core::ByteRange>& unused) const {
  for (const Column& column : columns_) cut_rows(file, column.path, written_, unused);
}

void cut_rows(hid_t file, const std::string& path, hsize_t num_rows, std::vector<core::ByteRange>& unused) {
  const auto dataset = owned<Dataset>(H5Dopen2(file, path.c_str(), H5P_DEFAULT), "H5Dopen(" + path + ")");
  std::vector<hsize_t> dims = extent_of(owned<Dataspace>(H5Dget_space(dataset.id()), "H5Dget_space"));
  if (dims[0] == num_rows) return;
  add_unused_chunks(dataset.id(), num_rows, unused);
  dims[0] = num_rows;
  check(H5Dset_extent(dataset.id(), dims.data()), "H5Dset_extent(" + path + ")");
}

}  // namespace pbmpi::io
