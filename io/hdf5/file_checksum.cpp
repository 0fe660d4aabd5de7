#include "io/hdf5/file_checksum.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <sstream>
#include <vector>

#include "core/error.h"
#include "core/system/seal.h"
#include "io/hdf5/columns.h"
#include "io/hdf5/file_types.h"
#include "io/hdf5/read_columns.h"

namespace pbmpi::io {
namespace {

constexpr const char *fixed_name = "checksum", *end_name = "end_checksum";

void add_text(const std::string& text, core::Checksum& sum) {
  sum.add(std::as_bytes(std::span(text)));
  sum.add(std::as_bytes(std::span("", 1)));  // ends the text
}

/// Attributes that change while the file grows: these of the root, and all of /events and /world_results.
bool changes(const std::string& object, const std::string& attribute) {
  constexpr std::array names = {"frames_committed", "complete", "state_hash", fixed_name, end_name};
  return object == "/events" || object == world_results ||
         (object == "/" && std::ranges::find(names, attribute) != names.end());
}

void add_attributes(hid_t file, const std::string& object, bool that_change, core::Checksum& sum) {
  for (const auto& [name, text] : attributes_as_text(file, object)) {
    if (changes(object, name) != that_change || name == fixed_name || name == end_name) continue;
    add_text(name, sum);
    add_text(text, sum);
  }
}

/// Adds the shape and bytes of a dataset.
void add_values(hid_t file, const std::string& path, core::Checksum& sum) {
  const RawRows rows = raw_rows(file, path);
  std::vector<std::byte> values(rows.num_rows * rows.row_bytes);
  rows.read(0, rows.num_rows, values.data());
  for (const hsize_t dim : rows.dims) add_text(std::to_string(dim), sum);
  sum.add(values);
}

/// Adds the type of a dataset and, if it is not chunked, its shape and bytes.
void add_dataset(hid_t file, const std::string& path, core::Checksum& sum) {
  const auto dataset = owned<Dataset>(H5Dopen2(file, path.c_str(), H5P_DEFAULT), "H5Dopen(" + path + ")");
  const auto type = owned<Datatype>(H5Dget_type(dataset.id()), "H5Dget_type");
  const auto creation = owned<PropertyList>(H5Dget_create_plist(dataset.id()), "H5Dget_create_plist");
  std::size_t length = 0;
  check(H5Tencode(type.id(), nullptr, &length), "H5Tencode");
  std::vector<std::byte> encoded(length);  // X
  check(H5Tencode(type.id(), encoded.data(), &length), "H5Tencode");
  sum.add(encoded);
  if (H5Pget_layout(creation.id()) != H5D_CHUNKED) add_values(file, path, sum);
}

struct Walk {
  hid_t file;
  core::Checksum sum;
  std::string error;
};

/// For H5Lvisit: exceptions must not pass through HDF5.
herr_t visit(hid_t, const char* name, const H5L_info_t*, void* data) {
  Walk& walk = *static_cast<Walk*>(data);
  try {
    const std::string path = "/" + std::string(name);
    const auto object = owned<Object>(H5Oopen(walk.file, path.c_str(), H5P_DEFAULT), "H5Oopen(" + path + ")");
    add_text(path, walk.sum);
    add_attributes(walk.file, path, false, walk.sum);
    if (H5Iget_type(object.id()) == H5I_DATASET) add_dataset(walk.file, path, walk.sum);
    return 0;
  } catch (const std::exception& error) {
    walk.error = error.what();
    return -1;
  }
}

/// Never 0, which means that no checksum is stored.
std::int64_t stored_form(const core::Checksum& sum) {
  return std::max<std::int64_t>(static_cast<std::int64_t>(sum.value() >> 1), 1);
}

std::int64_t fixed_checksum(hid_t file) {
  Walk walk{file, {}, {}};
  add_attributes(file, "/", false, walk.sum);
  const herr_t status = H5Lvisit(file, H5_INDEX_NAME, H5_ITER_INC, visit, &walk);
  if (!walk.error.empty()) throw core::RunError(walk.error);
  check(status, "H5Lvisit");
  return stored_form(walk.sum);
}

std::int64_t end_checksum(hid_t file) {
  core::Checksum sum;
  add_attributes(file, "/", true, sum);
  add_attributes(file, "/events", true, sum);
  if (has_object(file, world_results)) {
    add_attributes(file, world_results, true, sum);
    for (const std::string& name : names_in(file, world_results))
      add_values(file, std::string(world_results) + "/" + name, sum);
  }
  return stored_form(sum);
}

void store(hid_t file, const char* name, std::int64_t value) {
  rewrite_attribute(file, "/", name, number_type(H5T_NATIVE_INT64), &value);
}

void require_checksum(hid_t file, const char* name, std::int64_t (*compute)(hid_t), const char* what) {
  const std::int64_t stored = integer_attribute(file, "/", name);
  if (stored != 0 && stored != compute(file))
    throw core::RunError(std::string(what) + " changed since it was written");
}

void check_table(hid_t file, const std::string& path, std::int64_t num_rows) {
  const auto attributes = attributes_as_text(file, path);
  const auto named = attributes.find("columns");
  if (named == attributes.end()) throw core::RunError(path + " has no attribute columns");
  std::vector<RawRows> columns;
  std::istringstream lines(named->second);
  std::size_t row_bytes = 1;
  for (std::string column; std::getline(lines, column);) {
    columns.push_back(raw_rows(file, column, num_rows));
    row_bytes += columns.back().row_bytes;
  }
  constexpr std::size_t piece_bytes = std::size_t{4} << 20;
  const auto piece = static_cast<hsize_t>(std::max<std::size_t>(piece_bytes / row_bytes, 1));
  const RawRows stored = raw_rows(file, path, num_rows);
  if (stored.row_bytes != sizeof(std::uint64_t)) throw core::RunError(path + " is no column of checksums");
  for (hsize_t first = 0; first < static_cast<hsize_t>(num_rows); first += piece) {
    const hsize_t count = std::min<hsize_t>(piece, static_cast<hsize_t>(num_rows) - first);
    std::vector<core::Checksum> sums(count);
    for (const RawRows& column : columns) {
      std::vector<std::byte> values(count * column.row_bytes);
      column.read(first, count, values.data());
      for (hsize_t row = 0; row < count; ++row)
        sums[row].add(std::span(values).subspan(row * column.row_bytes, column.row_bytes));
    }
    std::vector<std::uint64_t> expected(count);
    stored.read(first, count, expected.data());
    for (hsize_t row = 0; row < count; ++row) {
      if (sums[row].value() != expected[row])
        throw core::RunError("row " + std::to_string(first + row) + " of the table of " +
                             columns.front().path + " changed since it was written");
    }
  }
}

}  // namespace

std::string row_checksum_path(const std::string& first_column) {
  std::string name = first_column.substr(1);
  std::ranges::replace(name, '/', '.');
  return std::string(row_checksums) + "/" + name;
}

void create_checksum_attributes(hid_t root) {
  write_attribute(root, fixed_name, std::int64_t{0});
  write_attribute(root, end_name, std::int64_t{0});
}

void store_fixed_checksum(hid_t file) { store(file, fixed_name, fixed_checksum(file)); }
void store_end_checksum(hid_t file) { store(file, end_name, end_checksum(file)); }

void check_checksums(hid_t file) {
  if (!attributes_as_text(file, "/").contains(fixed_name)) return;
  require_checksum(file, fixed_name, fixed_checksum, "what is written once (parameters, bodies, geoms ...)");
  require_checksum(file, end_name, end_checksum,
                   "what the run's end has written (state hash, number of frames ...)");
}

void check_rows(hid_t file,
                const std::function<std::optional<std::int64_t>(const std::string& name)>& num_rows) {
  if (!has_object(file, row_checksums)) return;
  for (const std::string& name : names_in(file, row_checksums)) {
    if (const auto rows = num_rows(name)) check_table(file, std::string(row_checksums) + "/" + name, *rows);
  }
}

}  // namespace pbmpi::io
