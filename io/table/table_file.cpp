#include "io/table/table_file.h"

#include <algorithm>
#include <array>
#include <cstring>

#include "core/error.h"
#include "core/system/input_file.h"
#include "core/system/seal.h"
#include "core/text.h"
#include "io/file/write_file.h"
#include "io/hdf5/columns.h"
#include "io/hdf5/read_columns.h"

namespace pbmpi::io {
namespace {

struct Length {
  std::size_t operator()(const auto& values) const { return values.size(); }
};

void write_values(hid_t file, const std::string& path, const Datatype& type, const std::vector<hsize_t>& dims,
                  const std::string& unit, const void* values) {
  const Dataset dataset = create_fixed(file, path, type, dims, unit);
  if (dims[0] == 0) return;
  check(H5Dwrite(dataset.id(), type.id(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values), "H5Dwrite(" + path + ")");
}

struct WriteColumn {
  hid_t file;
  const std::string& path;
  const TableColumn& column;

  std::vector<hsize_t> dims() const {
    std::vector<hsize_t> dims = {column.num_rows()};
    if (column.width > 1) dims.push_back(column.width);
    return dims;
  }
  void operator()(const std::vector<double>& values) const {
    write_values(file, path, number_type(H5T_NATIVE_DOUBLE), dims(), column.unit, values.data());
  }
  void operator()(const std::vector<std::int64_t>& values) const {
    write_values(file, path, number_type(H5T_NATIVE_INT64), dims(), column.unit, values.data());
  }
  void operator()(const std::vector<std::string>& values) const {
    std::size_t bytes = 1;
    for (const std::string& text : values) bytes = std::max(bytes, text.size());
    std::vector<char> padded(bytes * values.size(), '\0');
    for (std::size_t i = 0; i < values.size(); ++i) values[i].copy(&padded[i * bytes], bytes);
    write_values(file, path, text_type(bytes), dims(), column.unit, padded.data());
  }
};

void write_content(hid_t file, const std::string& filetype, const std::array<std::int64_t, 2>& version,
                   const TableFile& content) {
  const auto root = owned<Group>(H5Gopen2(file, "/", H5P_DEFAULT), "H5Gopen(/)");
  write_attribute(root.id(), "filetype", filetype);
  write_version(root.id(), version);
  for (const auto& [name, value] : content.attributes) write_attribute(root.id(), name, value);
  const Group parameters = create_group(file, "/parameters");
  for (const Parameter& parameter : content.parameters) {
    create_scalar(parameters.id(), parameter.name, parameter, true);
  }
  for (const auto& [table, columns] : content.tables) {
    for (const TableColumn& column : columns) {
      const std::string where = "/" + table + "/" + column.name;
      core::require_invariant(column.num_rows() == columns.front().num_rows(), "columns of one length");
      std::visit(WriteColumn{file, where, column}, column.values);
    }
  }
}

/// Minor version of the layouts from which on files have a seal.
constexpr std::int64_t sealed_since = 3;

TableColumn read_column(hid_t file, const std::string& table, const std::string& name) {
  const std::string path = "/" + table + "/" + name;
  const auto dataset = owned<Dataset>(H5Dopen2(file, path.c_str(), H5P_DEFAULT), "H5Dopen(" + path + ")");
  const auto type = owned<Datatype>(H5Dget_type(dataset.id()), "H5Dget_type");
  const std::vector<hsize_t> dims = dims_of(file, path);
  TableColumn column{name, "", {}, dims.size() > 1 ? static_cast<std::size_t>(dims[1]) : 1};
  const auto attributes = attributes_as_text(file, path);
  if (const auto unit = attributes.find("unit"); unit != attributes.end()) column.unit = unit->second;
  switch (H5Tget_class(type.id())) {
    case H5T_STRING:
      column.values = read_texts(file, path);
      break;
    case H5T_INTEGER:
      column.values = read_integers(file, path);
      break;
    default:
      column.values = read_doubles(file, path);
  }
  return column;
}

TableFile read_all(hid_t file) {
  TableFile content;
  content.attributes = attributes_as_text(file, "/");
  for (const auto& [name, value] : scalars_as_text(file, "/parameters")) {
    content.parameters.push_back(Parameter::of(name, value));
  }
  for (const std::string& table : names_in(file, "/")) {
    if (table == "parameters") continue;
    for (const std::string& name : names_in(file, "/" + table)) {
      content.tables[table].push_back(read_column(file, table, name));
    }
  }
  return content;
}

}  // namespace

std::size_t TableColumn::num_rows() const { return std::visit(Length{}, values) / width; }

bool TableFile::has_column(const std::string& table, const std::string& name) const {
  const auto group = tables.find(table);
  return group != tables.end() && std::any_of(group->second.begin(), group->second.end(),
                                              [&](const TableColumn& column) { return column.name == name; });
}

const TableColumn& TableFile::find(const std::string& table, const std::string& name) const {
  const auto group = tables.find(table);
  if (group != tables.end()) {
    for (const TableColumn& column : group->second) {
      if (column.name == name) return column;
    }
  }
  throw core::InputError("the file has no column /" + table + "/" + name + "; use the pbmpi that wrote it");
}

void TableFile::throw_type(const std::string& table, const std::string& name) {
  throw core::InputError("the column /" + table + "/" + name +
                         " has another type than expected; use the pbmpi that wrote it");
}

TableWriter::TableWriter(const std::string& path) {
  prepare_hdf5();
  lock_ = output_target(path, study_filetype, table_bytes).take_lock();
}

void TableWriter::write(const std::string& filetype, const TableFile& file) {
  replace_file(lock_, table_image(filetype, study_version, file));
}

std::vector<std::byte> table_image(const std::string& filetype, const std::array<std::int64_t, 2>& version,
                                   const TableFile& content) {
  prepare_hdf5();
  constexpr std::size_t growth_bytes = std::size_t{1} << 20;
  const auto access = owned<PropertyList>(H5Pcreate(H5P_FILE_ACCESS), "H5Pcreate");
  check(H5Pset_fapl_core(access.id(), growth_bytes, 0), "H5Pset_fapl_core");
  const auto file =
      owned<File>(H5Fcreate("in memory", H5F_ACC_TRUNC, H5P_DEFAULT, access.id()), "H5Fcreate(in memory)");
  write_content(file.id(), filetype, version, content);
  check(H5Fflush(file.id(), H5F_SCOPE_GLOBAL), "H5Fflush");
  const ssize_t size = H5Fget_file_image(file.id(), nullptr, 0);
  check(size < 0 ? -1 : 0, "H5Fget_file_image");
  std::vector<std::byte> image(static_cast<std::size_t>(size));
  check(H5Fget_file_image(file.id(), image.data(), image.size()) < 0 ? -1 : 0, "H5Fget_file_image");
  if (version[1] >= sealed_since) core::add_seal(image);
  return image;
}

TableFile read_table_file(const std::string& path, const std::string& filetype, std::int64_t major) {
  const File file = open_file(path, filetype, major, sealed_since);
  try {
    return read_all(file.id());
  } catch (const core::RunError& error) {
    throw core::InputError(path + ": " + error.what() + "; the file is damaged or incomplete");
  }
}

OutputTarget output_target(const std::string& path, const std::string& filetype, std::int64_t bytes) {
  OutputTarget target(path, bytes);
  if (content_of(target.path()) == Content::nothing) return target;
  const std::string found = filetype_of(target.path());
  if (found.empty() || found != filetype)
    refuse_output(path,
                  "an HDF5 file is there that " +
                      (found.empty() ? "has no readable attribute filetype" : "is of type " + found) +
                      ", which one of type " + filetype + " would replace",
                  "give another name, or remove it first");
  return target;
}

std::string root_text(const std::string& path, const std::string& attribute) {
  prepare_hdf5();
  if (content_of(path) != Content::hdf5) return "";  // a pipe is not even opened
  try {
    if (core::seal_of(path) == core::Seal::broken) return "";  // nothing in the file can be trusted
    const File file = open_unlocked(path);
    return core::value_in(attributes_as_text(file.id(), "/"), attribute);
  } catch (const std::runtime_error&) {
    return "";
  }
}

}  // namespace pbmpi::io
