#include "io/hdf5/columns.h"

#include <algorithm>

#include "io/hdf5/rows.h"

namespace pbmpi::io {
namespace {

PropertyList with_parents() {
  auto links = owned<PropertyList>(H5Pcreate(H5P_LINK_CREATE), "H5Pcreate");
  check(H5Pset_create_intermediate_group(links.id(), 1), "H5Pset_create_intermediate_group");
  return links;
}

PropertyList allocated_now() {
  auto creation = owned<PropertyList>(H5Pcreate(H5P_DATASET_CREATE), "H5Pcreate");
  check(H5Pset_alloc_time(creation.id(), H5D_ALLOC_TIME_EARLY), "H5Pset_alloc_time");
  check(H5Pset_fill_time(creation.id(), H5D_FILL_TIME_NEVER), "H5Pset_fill_time");
  return creation;
}

/// Writes the unit in ASCII, as H5MD's module of units requires.
void write_unit(hid_t dataset, const std::string& unit) {
  const Datatype type = text_type(unit.size());
  check(H5Tset_cset(type.id(), H5T_CSET_ASCII), "H5Tset_cset");
  const auto space = owned<Dataspace>(H5Screate(H5S_SCALAR), "H5Screate");
  const auto attribute = owned<Attribute>(
      H5Acreate2(dataset, "unit", type.id(), space.id(), H5P_DEFAULT, H5P_DEFAULT), "H5Acreate(unit)");
  check(H5Awrite(attribute.id(), type.id(), unit.data()), "H5Awrite(unit)");
}

Dataset create(hid_t file, const std::string& path, const Datatype& type, const Dataspace& space,
               const PropertyList& creation, const std::string& unit) {
  const PropertyList links = with_parents();
  auto dataset = owned<Dataset>(
      H5Dcreate2(file, path.c_str(), type.id(), space.id(), links.id(), creation.id(), H5P_DEFAULT),
      "H5Dcreate(" + path + ")");
  if (!unit.empty()) write_unit(dataset.id(), unit);
  return dataset;
}

/// The file type of a parameter and where its bytes are. An empty text is one NUL.
struct Bytes {
  Datatype type;
  const void* data;
};

Bytes bytes_of(const Parameter& value) {
  switch (value.type) {
    case Parameter::Type::integer:
      return {number_type(H5T_NATIVE_INT64), &value.integer};
    case Parameter::Type::real:
      return {number_type(H5T_NATIVE_DOUBLE), &value.real};
    case Parameter::Type::text:
      break;
  }
  return {text_type(std::max<std::size_t>(value.text.size(), 1)), value.text.c_str()};
}

}  // namespace

Datatype text_type(std::size_t bytes) {
  auto type = owned<Datatype>(H5Tcopy(H5T_C_S1), "H5Tcopy");
  check(H5Tset_size(type.id(), bytes), "H5Tset_size");
  check(H5Tset_strpad(type.id(), H5T_STR_NULLPAD), "H5Tset_strpad");
  check(H5Tset_cset(type.id(), H5T_CSET_UTF8), "H5Tset_cset");
  return type;
}

Datatype number_type(hid_t native) { return owned<Datatype>(H5Tcopy(native), "H5Tcopy"); }

std::string cut_text(std::string_view text, std::size_t bytes) {
  if (text.size() <= bytes) return std::string(text);
  const auto continues = [](char c) { return (static_cast<unsigned char>(c) & 0xc0u) == 0x80u; };
  while (bytes > 0 && continues(text[bytes])) --bytes;
  return std::string(text.substr(0, bytes));
}

void write_attribute(hid_t object, const std::string& name, std::int64_t value) {
  write_attribute(object, Parameter::of(name, value));
}

void write_attribute(hid_t object, const std::string& name, const std::string& value) {
  write_attribute(object, Parameter::of(name, value));
}

void write_attribute(hid_t object, const Parameter& value) {
  constexpr std::size_t most_bytes = 60000;  // HDF5 keeps an attribute in an object header, below 64 KiB
  Parameter fitting = value;
  fitting.text = cut_text(value.text, most_bytes);
  const Bytes bytes = bytes_of(fitting);
  const auto space = owned<Dataspace>(H5Screate(H5S_SCALAR), "H5Screate");
  const auto attribute = owned<Attribute>(
      H5Acreate2(object, value.name.c_str(), bytes.type.id(), space.id(), H5P_DEFAULT, H5P_DEFAULT),
      "H5Acreate(" + value.name + ")");
  check(H5Awrite(attribute.id(), bytes.type.id(), bytes.data), "H5Awrite(" + value.name + ")");
}

void write_reference(hid_t object, const std::string& name, hid_t file, const std::string& path) {
  hobj_ref_t reference{};
  check(H5Rcreate(&reference, file, path.c_str(), H5R_OBJECT, -1), "H5Rcreate(" + path + ")");
  const auto space = owned<Dataspace>(H5Screate(H5S_SCALAR), "H5Screate");
  const auto attribute = owned<Attribute>(
      H5Acreate2(object, name.c_str(), H5T_STD_REF_OBJ, space.id(), H5P_DEFAULT, H5P_DEFAULT),
      "H5Acreate(" + name + ")");
  check(H5Awrite(attribute.id(), H5T_STD_REF_OBJ, &reference), "H5Awrite(" + name + ")");
}

void rewrite_attribute(hid_t file, const char* group, const std::string& name, const Datatype& type,
                       const void* value) {
  // Opened through the group, because HDF5 1.10 cannot write an attribute opened with H5Aopen_by_name.
  const auto owner = owned<Group>(H5Gopen2(file, group, H5P_DEFAULT), std::string("H5Gopen(") + group + ")");
  const auto attribute =
      owned<Attribute>(H5Aopen(owner.id(), name.c_str(), H5P_DEFAULT), "H5Aopen(" + name + ")");
  check(H5Awrite(attribute.id(), type.id(), value), "H5Awrite(" + name + ")");
}

void write_version(hid_t object, const std::array<std::int64_t, 2>& version) {
  const hsize_t length = version.size();
  const auto space = owned<Dataspace>(H5Screate_simple(1, &length, nullptr), "H5Screate_simple");
  const auto attribute =
      owned<Attribute>(H5Acreate2(object, "version", H5T_NATIVE_INT64, space.id(), H5P_DEFAULT, H5P_DEFAULT),
                       "H5Acreate(version)");
  check(H5Awrite(attribute.id(), H5T_NATIVE_INT64, version.data()), "H5Awrite(version)");
}

Dataset create_fixed(hid_t file, const std::string& path, const Datatype& type,
                     const std::vector<hsize_t>& dims, const std::string& unit) {
  const auto space = owned<Dataspace>(H5Screate_simple(static_cast<int>(dims.size()), dims.data(), nullptr),
                                      "H5Screate_simple");
  return create(file, path, type, space, allocated_now(), unit);
}

Dataset create_growing(hid_t file, const std::string& path, const Datatype& type,
                       const std::vector<hsize_t>& dims, const std::string& unit, hsize_t rows_a_chunk) {
  const int rank = static_cast<int>(dims.size());
  std::vector<hsize_t> most = dims;
  most[0] = H5S_UNLIMITED;
  const auto space = owned<Dataspace>(H5Screate_simple(rank, dims.data(), most.data()), "H5Screate_simple");
  const PropertyList creation = allocated_now();
  std::vector<hsize_t> chunk = chunk_shape(dims, H5Tget_size(type.id()));
  if (rows_a_chunk > 0) chunk = dims, chunk[0] = rows_a_chunk;
  for (hsize_t& edge : chunk) edge = std::max<hsize_t>(edge, 1);
  check(H5Pset_chunk(creation.id(), rank, chunk.data()), "H5Pset_chunk(" + path + ")");
  return create(file, path, type, space, creation, unit);
}

void create_scalar(hid_t file, const std::string& path, const Parameter& value, bool write) {
  const auto space = owned<Dataspace>(H5Screate(H5S_SCALAR), "H5Screate");
  const Bytes bytes = bytes_of(value);
  const Dataset dataset = create(file, path, bytes.type, space, allocated_now(), "");
  if (!write) return;
  check(H5Dwrite(dataset.id(), bytes.type.id(), H5S_ALL, H5S_ALL, H5P_DEFAULT, bytes.data),
        "H5Dwrite(" + path + ")");
}

Group create_group(hid_t file, const std::string& path) {
  const PropertyList links = with_parents();
  return owned<Group>(H5Gcreate2(file, path.c_str(), links.id(), H5P_DEFAULT, H5P_DEFAULT),
                      "H5Gcreate(" + path + ")");
}

}  // namespace pbmpi::io
