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

/// The columns of a table and the checksums of their rows, which the dataset `path` lists.
struct Table {
  std::vector<RawRows> columns;
  RawRows checksums;
};

Table open_table(hid_t file, const std::string& path, std::int64_t num_rows) {
  const auto attributes = attributes_as_text(file, path);
  const auto named = attributes.find("columns");
  if (named == attributes.end()) throw core::RunError(path + " has no attribute columns");
  Table table{{}, raw_rows(file, path, num_rows)};
  std::istringstream lines(named->second);
  for (std::string column; std::getline(lines, column);)
    table.columns.push_back(raw_rows(file, column, num_rows));
  if (table.checksums.row_bytes != sizeof(std::uint64_t))
    throw core::RunError(path + " is no column of checksums");
  return table;
}

/// Calls take(first row, checksums) with the checksums of the table's rows as they are, piece by piece.
template <class Take>
void sum_rows(const Table& table, Take&& take) {
  constexpr std::size_t piece_bytes = std::size_t{4} << 20;
  std::size_t row_bytes = 1;
  for (const RawRows& column : table.columns) row_bytes += column.row_bytes;
  const hsize_t num_rows = table.checksums.num_rows;
  const auto piece = static_cast<hsize_t>(std::max<std::size_t>(piece_bytes / row_bytes, 1));
  for (hsize_t first = 0; first < num_rows; first += piece) {
    const hsize_t count = std::min<hsize_t>(piece, num_rows - first);
    std::vector<core::Checksum> sums(count);
    for (const RawRows& column : table.columns) {
      std::vector<std::byte> values(count * column.row_bytes);
      column.read(first, count, values.data());
      for (hsize_t row = 0; row < count; ++row)
        sums[row].add(std::span(values).subspan(row * column.row_bytes, column.row_bytes));
    }
    std::vector<std::uint64_t> values(count);
    std::ranges::transform(sums, values.begin(), &core::Checksum::value);
    take(first, values);
  }
}

void check_table(const Table& table) {
  sum_rows(table, [&](hsize_t first, const std::vector<std::uint64_t>& sums) {
    std::vector<std::uint64_t> stored(sums.size());
    table.checksums.read(first, stored.size(), stored.data());
    const auto row = std::ranges::mismatch(sums, stored).in1 - sums.begin();
    if (row < std::ssize(sums))
      throw core::RunError("row " + std::to_string(first + static_cast<hsize_t>(row)) + " of the table of " +
                           table.columns.front().path + " changed since it was written");
  });
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

void store_row_checksums(hid_t file) {
  for (const std::string& name : names_in(file, row_checksums)) {
    const Table table = open_table(file, std::string(row_checksums) + "/" + name, -1);
    sum_rows(table, [&](hsize_t first, const std::vector<std::uint64_t>& sums) {
      table.checksums.write(first, sums.size(), sums.data());
    });
  }
}

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
    if (const auto rows = num_rows(name))
      check_table(open_table(file, std::string(row_checksums) + "/" + name, *rows));
  }
}

}  // namespace pbmpi::io
