#include "io/hdf5/read_columns.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <optional>
#include <span>

#include "core/error.h"
#include "core/system/input_file.h"
#include "core/system/seal.h"
#include "core/text.h"
#include "io/hdf5/columns.h"
#include "io/hdf5/file_types.h"
#include "io/hdf5/rows.h"

namespace pbmpi::io {
namespace {

std::string trimmed(const char* text, std::size_t bytes) {
  const std::string all(text, bytes);
  return all.substr(0, all.find('\0'));
}

/// Turns the values of a dataset or an attribute into text; `read(type, buffer)` reads them.
template <class Read>
std::string values_as_text(const Datatype& type, hsize_t count, Read&& read) {
  const std::size_t bytes = H5Tget_size(type.id());
  std::vector<std::string> parts;
  switch (H5Tget_class(type.id())) {
    case H5T_STRING: {
      if (H5Tis_variable_str(type.id()) > 0) return "(text of variable length)";
      std::vector<char> buffer(bytes * count);
      read(type.id(), buffer.data());
      for (hsize_t i = 0; i < count; ++i) parts.push_back(trimmed(&buffer[i * bytes], bytes));
      break;
    }
    case H5T_INTEGER: {
      std::vector<std::int64_t> buffer(count);
      read(H5T_NATIVE_INT64, buffer.data());
      for (const std::int64_t value : buffer) parts.push_back(core::number_text(value));
      break;
    }
    case H5T_FLOAT: {
      std::vector<double> buffer(count);
      read(H5T_NATIVE_DOUBLE, buffer.data());
      for (const double value : buffer) parts.push_back(core::number_text(value));
      break;
    }
    default:
      return "(of a type that pbmpi does not read)";
  }
  std::string joined;
  for (const std::string& part : parts) joined += (joined.empty() ? "" : ".") + part;
  return joined;
}

hsize_t num_points(const Dataspace& space) {
  const hssize_t points = H5Sget_simple_extent_npoints(space.id());
  check(points < 0 ? -1 : 0, "H5Sget_simple_extent_npoints");
  return static_cast<hsize_t>(points);
}

/// Throws unless that many values of that many bytes fit into the file; called before memory is allocated for
/// them. pbmpi's files are not compressed. `count`: values, or none for a product that overflowed.
void require_in_file(hid_t object, std::optional<hsize_t> count, std::size_t bytes, const std::string& path) {
  hsize_t file_bytes = 0;
  const auto file = owned<File>(H5Iget_file_id(object), "H5Iget_file_id");
  check(H5Fget_filesize(file.id(), &file_bytes), "H5Fget_filesize");
  if (!count || *count > file_bytes / std::max<std::size_t>(bytes, 1))
    throw core::RunError(path + " says that it holds more than the file does");
}

/// The product of the extents; none if it overflows.
std::optional<hsize_t> product(std::span<const hsize_t> dims) {
  hsize_t count = 1;
  for (const hsize_t dim : dims) {
    if (__builtin_mul_overflow(count, dim, &count)) return std::nullopt;
  }
  return count;
}

/// The first rows of a dataset that has rows; `row_values`: values of each, 0 = any number.
RawRows rows_of_values(hid_t file, const std::string& path, std::int64_t num_rows, hsize_t row_values) {
  RawRows rows = raw_rows(file, path, num_rows);
  if (rows.dims.empty()) throw core::RunError(path + " has no rows");
  const hsize_t values = rows.row_bytes / H5Tget_size(rows.type.id());
  if (row_values != 0 && values != row_values) {
    throw core::RunError(path + " has rows of " + std::to_string(values) + " values, not " +
                         std::to_string(row_values));
  }
  return rows;
}

template <class Number>
std::vector<Number> read_numbers(hid_t file, const std::string& path, std::int64_t num_rows,
                                 hsize_t row_values, hid_t type) {
  RawRows rows = rows_of_values(file, path, num_rows, row_values);
  std::vector<Number> values(rows.num_rows * rows.row_bytes / H5Tget_size(rows.type.id()));
  rows.type = number_type(type);
  rows.read(0, rows.num_rows, values.data());
  return values;
}

/// Returns the minor version of the layout.
std::int64_t require_type(const std::string& path, hid_t file, const std::string& type, std::int64_t layout) {
  const auto attributes = attributes_as_text(file, "/");
  const auto found = attributes.find("filetype");
  const bool is_run = type == filetype;
  const std::string writer = type == checkpoint_filetype || is_run ? "pbmpi" : "pbstudy";
  core::require_input(found != attributes.end() && found->second == type,
                      path + ": not a " + (is_run ? "pbmpi run" : type) + " (its attribute filetype is " +
                          (found == attributes.end() ? "missing" : "\"" + found->second + "\"") +
                          "); give a file that " + writer + " has written");
  const auto version = attributes.find("version");
  const std::int64_t major = version == attributes.end() ? 0 : std::atoll(version->second.c_str());
  core::require_input(major == layout, path + ": its layout has version " +
                                           (major == 0 ? "unknown" : version->second) +
                                           ", this program reads version " + core::number_text(layout) +
                                           ".x; use the pbmpi that wrote it");
  const std::size_t dot = version->second.find('.');
  return dot == std::string::npos ? 0 : std::atoll(version->second.c_str() + dot + 1);
}

}  // namespace

File open_unlocked(const std::string& path) {
  const auto access = owned<PropertyList>(H5Pcreate(H5P_FILE_ACCESS), "H5Pcreate");
  check(H5Pset_file_locking(access.id(), 0, 1), "H5Pset_file_locking");
  return owned<File>(H5Fopen(path.c_str(), H5F_ACC_RDONLY, access.id()), "H5Fopen");
}

File open_run(const std::string& path) { return open_file(path, filetype, layout_major); }

File open_file(const std::string& path, const std::string& type, std::int64_t major,
               std::optional<std::int64_t> sealed_since) {
  prepare_hdf5();
  const core::Seal seal = core::seal_of(path);
  core::require_input(
      seal != core::Seal::broken,
      path + ": its bytes do not have the checksum that was written with them; the file is damaged");
  File file;
  try {
    file = open_unlocked(path);
  } catch (const core::RunError& e) {
    throw core::InputError(path + ": cannot be opened as an HDF5 file (" + e.what() +
                           "); give a file that pbmpi has written");
  }
  try {
    const std::int64_t minor = require_type(path, file.id(), type, major);
    core::require_input(
        !sealed_since || minor < *sealed_since || seal == core::Seal::intact,
        path + ": its checksum is missing; the file is damaged, or another program has written into it");
  } catch (const core::RunError& e) {
    throw core::InputError(path + ": " + e.what() + "; the file is damaged");
  }
  return file;
}

bool has_object(hid_t file, const std::string& path) {
  for (std::size_t end = path.find('/', 1);; end = path.find('/', end + 1)) {  // H5Lexists needs each group
    const htri_t found = H5Lexists(file, path.substr(0, end).c_str(), H5P_DEFAULT);
    check(found < 0 ? -1 : 0, "H5Lexists(" + path + ")");
    if (found == 0 || end == std::string::npos) return found > 0;
  }
}

std::vector<hsize_t> dims_of(hid_t file, const std::string& path) {
  const auto dataset = owned<Dataset>(H5Dopen2(file, path.c_str(), H5P_DEFAULT), "H5Dopen(" + path + ")");
  return extent_of(owned<Dataspace>(H5Dget_space(dataset.id()), "H5Dget_space"));
}

std::vector<double> read_doubles(hid_t file, const std::string& path, std::int64_t num_rows,
                                 hsize_t row_values) {
  return read_numbers<double>(file, path, num_rows, row_values, H5T_NATIVE_DOUBLE);
}

std::vector<std::int64_t> read_integers(hid_t file, const std::string& path, std::int64_t num_rows) {
  return read_numbers<std::int64_t>(file, path, num_rows, 0, H5T_NATIVE_INT64);
}

std::vector<std::string> read_texts(hid_t file, const std::string& path, std::int64_t num_rows) {
  const RawRows rows = rows_of_values(file, path, num_rows, 1);
  if (H5Tget_class(rows.type.id()) != H5T_STRING) throw core::RunError(path + " is not text");
  const std::size_t bytes = rows.row_bytes;
  std::vector<char> buffer(bytes * rows.num_rows);
  rows.read(0, rows.num_rows, buffer.data());
  std::vector<std::string> texts;
  texts.reserve(rows.num_rows);
  for (hsize_t i = 0; i < rows.num_rows; ++i) texts.push_back(trimmed(&buffer[i * bytes], bytes));
  return texts;
}

RawRows raw_rows(hid_t file, const std::string& path, std::int64_t num_rows) {
  RawRows rows;
  rows.path = path;
  rows.dataset = owned<Dataset>(H5Dopen2(file, path.c_str(), H5P_DEFAULT), "H5Dopen(" + path + ")");
  rows.type = owned<Datatype>(H5Dget_type(rows.dataset.id()), "H5Dget_type");
  if (H5Tis_variable_str(rows.type.id()) > 0 || H5Tdetect_class(rows.type.id(), H5T_VLEN) > 0)
    throw core::RunError(path + " has a type that pbmpi does not write");
  rows.dims = dims_of(file, path);
  rows.num_rows = rows.dims.empty() ? 1 : rows.dims[0];
  if (num_rows >= 0 && !rows.dims.empty()) {
    if (rows.dims[0] < static_cast<hsize_t>(num_rows))
      throw core::RunError(path + " has " + std::to_string(rows.dims[0]) + " rows, not " +
                           std::to_string(num_rows));
    rows.num_rows = rows.dims[0] = static_cast<hsize_t>(num_rows);
  }
  const std::size_t bytes = H5Tget_size(rows.type.id());
  require_in_file(file, product(rows.dims), bytes, path);
  const auto width = product(std::span(rows.dims).subspan(rows.dims.empty() ? 0 : 1));
  require_in_file(file, width, bytes, path);
  rows.row_bytes = bytes * *width;
  return rows;
}

void RawRows::read(hsize_t first, hsize_t count, void* values) const {
  if (count == 0 || row_bytes == 0) return;
  const auto in_file = owned<Dataspace>(H5Dget_space(dataset.id()), "H5Dget_space");
  const Dataspace in_memory = select_rows(in_file, {first, count});
  check(H5Dread(dataset.id(), type.id(), in_memory.id(), in_file.id(), H5P_DEFAULT, values),
        "H5Dread(" + path + ")");
}

void RawRows::write(hsize_t first, hsize_t count, const void* values) const {
  write_rows(dataset, type.id(), {first, count}, values, path);
}

std::vector<std::string> names_in(hid_t file, const std::string& path) {
  const auto group = owned<Group>(H5Gopen2(file, path.c_str(), H5P_DEFAULT), "H5Gopen(" + path + ")");
  H5G_info_t info;
  check(H5Gget_info(group.id(), &info), "H5Gget_info");
  std::vector<std::string> names;
  for (hsize_t i = 0; i < info.nlinks; ++i) {
    std::array<char, 256> name{};
    check(H5Lget_name_by_idx(group.id(), ".", H5_INDEX_NAME, H5_ITER_INC, i, name.data(), name.size(),
                             H5P_DEFAULT) < 0
              ? -1
              : 0,
          "H5Lget_name_by_idx");
    names.emplace_back(name.data());
  }
  return names;
}

std::int64_t integer_attribute(hid_t file, const std::string& object, const std::string& name) {
  const auto attribute = owned<Attribute>(
      H5Aopen_by_name(file, object.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT), "H5Aopen(" + name + ")");
  const auto space = owned<Dataspace>(H5Aget_space(attribute.id()), "H5Aget_space");
  if (num_points(space) != 1) throw core::RunError("attribute " + name + " is not one number");
  std::int64_t value = 0;
  check(H5Aread(attribute.id(), H5T_NATIVE_INT64, &value), "H5Aread(" + name + ")");
  return value;
}

std::map<std::string, std::string> attributes_as_text(hid_t file, const std::string& object) {
  const auto owner = owned<Object>(H5Oopen(file, object.c_str(), H5P_DEFAULT), "H5Oopen(" + object + ")");
  H5O_info_t info;
  check(H5Oget_info2(owner.id(), &info, H5O_INFO_NUM_ATTRS), "H5Oget_info");
  std::map<std::string, std::string> texts;
  for (hsize_t i = 0; i < info.num_attrs; ++i) {
    const auto attribute = owned<Attribute>(
        H5Aopen_by_idx(owner.id(), ".", H5_INDEX_NAME, H5_ITER_INC, i, H5P_DEFAULT, H5P_DEFAULT),
        "H5Aopen_by_idx");
    std::array<char, 256> name{};
    check(H5Aget_name(attribute.id(), name.size(), name.data()) < 0 ? -1 : 0, "H5Aget_name");
    const auto type = owned<Datatype>(H5Aget_type(attribute.id()), "H5Aget_type");
    const auto space = owned<Dataspace>(H5Aget_space(attribute.id()), "H5Aget_space");
    require_in_file(file, num_points(space), H5Tget_size(type.id()), name.data());
    texts[name.data()] = values_as_text(type, num_points(space), [&](hid_t as, void* values) {
      check(H5Aread(attribute.id(), as, values), "H5Aread");
    });
  }
  return texts;
}

std::map<std::string, std::string> scalars_as_text(hid_t file, const std::string& group) {
  std::map<std::string, std::string> texts;
  for (const std::string& name : names_in(file, group)) {
    const auto dataset = owned<Dataset>(H5Dopen2(file, (group + "/" + name).c_str(), H5P_DEFAULT), "H5Dopen");
    const auto type = owned<Datatype>(H5Dget_type(dataset.id()), "H5Dget_type");
    const auto space = owned<Dataspace>(H5Dget_space(dataset.id()), "H5Dget_space");
    require_in_file(file, num_points(space), H5Tget_size(type.id()), name);
    texts[name] = values_as_text(type, num_points(space), [&](hid_t as, void* values) {
      check(H5Dread(dataset.id(), as, H5S_ALL, H5S_ALL, H5P_DEFAULT, values), "H5Dread");
    });
  }
  return texts;
}

}  // namespace pbmpi::io
